# Functions for the other scripts: they check for required tools and install missing ones. Sourced, not run.
# shellcheck shell=bash

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

TRUNK_VERSION=0.21.14
# Folder of the tools that cargo builds. All checkouts share it; the user's own tools are untouched.
TOOLS=${XDG_CACHE_HOME:-$HOME/.cache}/seastate/tools
export PATH=$TOOLS/bin:$HOME/.cargo/bin:$PATH

say() { printf '\n==> %s\n' "$*"; }
note() { printf '    %s\n' "$*"; }
die() {
  printf '\n%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}
have() { command -v "$1" >/dev/null 2>&1; }

# need_packages NAME...: installs Debian packages. Without apt-get, or without root and sudo, it lists them and stops.
need_packages() {
  [ $# -gt 0 ] || return 0
  local as_root=() by_hand="missing: $*. Install these packages (the names are Debian's), then run this again."
  if [ "$(id -u)" -ne 0 ]; then
    have sudo || die "$by_hand"
    as_root=(sudo)
  fi
  have apt-get || die "$by_hand"
  say "Installing $*"
  "${as_root[@]}" apt-get update -qq || note "apt-get update failed; using the package lists of the last update"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@" >/dev/null ||
    die "could not install: $*"
}

# Rust with rustfmt and clippy, and the C linker that Rust needs.
need_rust() {
  local missing=()
  have cc || missing+=(build-essential)
  have pkg-config || missing+=(pkg-config)
  need_packages "${missing[@]}"
  have cargo || die "cargo is missing. Install Rust from https://rustup.rs, then run this again."
  have_component rustfmt || add_component rustfmt
  have_component clippy || add_component clippy
}
have_component() {
  case $1 in
    rustfmt) cargo fmt --version ;;
    clippy) cargo clippy --version ;;
  esac >/dev/null 2>&1
}
add_component() {
  have rustup || die "$1 is missing. Install it for your Rust, or install Rust from https://rustup.rs."
  rustup component add "$1" || die "could not add $1"
}

# Rust's target for browsers, trunk, and wasm-bindgen in the version of Cargo.lock.
need_wasm_tools() {
  if [ ! -d "$(rustc --print sysroot)/lib/rustlib/wasm32-unknown-unknown" ]; then
    have rustup || die "Rust's target wasm32-unknown-unknown is missing. Add it, or install https://rustup.rs."
    say "Adding Rust's target for browsers"
    rustup target add wasm32-unknown-unknown
  fi
  need_cargo_tool trunk "$TRUNK_VERSION" trunk --no-default-features # without its downloads of other tools
  need_cargo_tool wasm-bindgen "$(locked_version wasm-bindgen)" wasm-bindgen-cli
}
# locked_version PACKAGE: its version in Cargo.lock.
locked_version() {
  awk -v name="$1" '$1 == "name" && $3 == "\"" name "\"" { getline; gsub(/"/, "", $3); print $3; exit }' Cargo.lock
}
# need_cargo_tool COMMAND VERSION PACKAGE [FLAG...]: builds exactly this version with cargo, once.
need_cargo_tool() {
  if have "$1" && [ "$("$1" --version 2>/dev/null | awk '{ print $2 }')" = "$2" ]; then return 0; fi
  say "Building $3 $2 (once, some minutes)"
  # No optimisation: the tools run for seconds, and build in a fraction of the time.
  # A target folder outside cargo's temporary one lets an interrupted build continue.
  local install=(env CARGO_PROFILE_RELEASE_OPT_LEVEL=0 CARGO_PROFILE_RELEASE_LTO=false
    CARGO_PROFILE_RELEASE_CODEGEN_UNITS=64 CARGO_TARGET_DIR="$TOOLS/build"
    cargo install --root "$TOOLS" "$3" --version "$2" "${@:4}")
  # The tool's own lock file first; newer dependencies if one of the locked versions was withdrawn.
  "${install[@]}" --locked || "${install[@]}" || die "could not build $3 $2"
  rm -rf "$TOOLS/build"
}

# Mesa's lavapipe, a software Vulkan driver: the tests run on the same adapter on every machine.
need_software_vulkan() {
  lavapipe >/dev/null || need_packages libvulkan1 mesa-vulkan-drivers
  lavapipe >/dev/null || die "Mesa's lavapipe (lvp_icd*.json) is not in Vulkan's driver folders"
}
# Prints the path of lavapipe's driver file.
lavapipe() {
  local file
  for file in /usr/share/vulkan/icd.d/lvp_icd*.json /usr/local/share/vulkan/icd.d/lvp_icd*.json; do
    [ -e "$file" ] && echo "$file" && return 0
  done
  return 1
}
# Makes lavapipe the only adapter of programs started by this shell.
use_software_vulkan() {
  VK_DRIVER_FILES=$(lavapipe)
  export VK_DRIVER_FILES VK_ICD_FILENAMES=$VK_DRIVER_FILES WGPU_ADAPTER_NAME=llvmpipe
  if [ -z "${XDG_RUNTIME_DIR:-}" ]; then
    XDG_RUNTIME_DIR=$PWD/target/runtime # without it the Vulkan loader prints a warning at every start
    mkdir -p -m 700 "$XDG_RUNTIME_DIR"
    export XDG_RUNTIME_DIR
  fi
}

# A virtual display for the window's tests, and xdotool, which moves the mouse and types.
need_display() {
  local missing=()
  have Xvfb || missing+=(xvfb)
  have xdotool || missing+=(xdotool)
  # The window loads this library at run time, so no package depends on it.
  compgen -G '/usr/lib*/libxkbcommon-x11.so.0' >/dev/null || compgen -G '/usr/lib/*/libxkbcommon-x11.so.0' >/dev/null ||
    missing+=(libxkbcommon-x11-0)
  need_packages "${missing[@]}"
}

# Chromium, Firefox, node, and the node packages of the browser tests.
need_browsers() {
  local missing=()
  have chromium || have chromium-browser || have google-chrome || [ -n "${CHROMIUM:-}" ] || missing+=(chromium)
  have firefox-esr || have firefox || [ -n "${FIREFOX:-}" ] || missing+=(firefox-esr)
  have node || missing+=(nodejs)
  have npm || missing+=(npm)
  need_packages "${missing[@]}"
  [ "$(node -p 'parseInt(process.versions.node)')" -ge 18 ] ||
    die "node $(node --version) is too old: version 18 or later is needed"
  if ! node -e '
    const wanted = require("./web/tests/package.json").dependencies;
    const read = (name) => JSON.parse(require("fs").readFileSync(`web/tests/node_modules/${name}/package.json`));
    const version = (name) => read(name).version;
    process.exit(Object.entries(wanted).every(([name, exact]) => version(name) === exact) ? 0 : 1);
  ' 2>/dev/null; then
    say "Installing the browser tests' packages"
    (cd web/tests && npm install --no-package-lock --no-fund --no-audit --loglevel=error)
  fi
}

# Builds the page into dist/ with trunk, whose last hook is scripts/finish.sh.
# SEASTATE_URL is the address that the page will have: link previews need an absolute address.
build_page() { NO_COLOR=true trunk build --release "$@"; }
