//! The native program; the page starts in `app::web`.

#[cfg(not(target_arch = "wasm32"))]
fn main() {
    std::process::exit(seastate::cli::main());
}

#[cfg(target_arch = "wasm32")]
fn main() {}
