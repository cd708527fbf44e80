//! Entry point of the native program. The web page starts in `app::web`.

#[cfg(not(target_arch = "wasm32"))]
fn main() {
    std::process::exit(seastate::cli::main());
}

#[cfg(target_arch = "wasm32")]
fn main() {}
