# Shared by the scripts here: finds what they need and installs what is missing. Sourced, not run.
# shellcheck shell=bash

set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

TRUNK_VERSION=0.21.14
# Tools that cargo installs: nobody's own are replaced, and all checkouts share them.
TOOLS=${XDG_CACHE_HOME:-$HOME/.cache}/seastate/tools
export PATH=$TOOLS/bin:$HOME/.cargo/bin:$PATH

say() { printf '\n==> %s\n' "$*"; }
note() { printf '    %s\n' "$*"; }
die() {
  printf '\n%s: %s\n' "$(basename "$0")" "$*" >&2
  exit 1
}
have() { command -v "$1" >/dev/null 2>&1; }

# need_packages NAME...: Debian packages, installed if root or sudo and apt are there, else named.
need_packages() {
  [ $# -gt 0 ] || return 0
  local as_root=()
  if [ "$(id -u)" -ne 0 ]; then
    have sudo || die "missing: $*. Install these packages (the names are Debian's), then run this again."
    as_root=(sudo)
  fi
  have apt-get || die "missing: $*. Install these packages (the names are Debian's), then run this again."
  say "Installing $*"
  "${as_root[@]}" apt-get update -qq || note "apt-get update failed; trying with the lists at hand"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -y -qq --no-install-recommends "$@" >/dev/null ||
    die "could not install: $*"
}

# A C linker for Rust, Rust itself, and its parts.
need_rust() {
  local missing=()
  have cc || missing+=(build-essential)
  have pkg-config || missing+=(pkg-config)
  need_packages "${missing[@]}"
  have cargo || die "there is no cargo. Rust's own installer is at https://rustup.rs; run it, then run this again."
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
  have rustup || die "there is no $1. Install it with your Rust, or Rust from https://rustup.rs."
  rustup component add "$1" || die "could not add $1"
}

# The browser's target, trunk, and the wasm-bindgen that Cargo.lock asks for.
need_wasm_tools() {
  if [ ! -d "$(rustc --print sysroot)/lib/rustlib/wasm32-unknown-unknown" ]; then
    have rustup || die "this Rust has no target wasm32-unknown-unknown. Install it, or Rust from https://rustup.rs."
    say "Adding Rust's target for the browser"
    rustup target add wasm32-unknown-unknown
  fi
  need_cargo_tool trunk "$TRUNK_VERSION" trunk --no-default-features # it fetches nothing
  need_cargo_tool wasm-bindgen "$(locked_version wasm-bindgen)" wasm-bindgen-cli
}
locked_version() {
  awk -v name="$1" '$1 == "name" && $3 == "\"" name "\"" { getline; gsub(/"/, "", $3); print $3; exit }' Cargo.lock
}
# need_cargo_tool COMMAND VERSION PACKAGE [FLAG...]: exactly that version, from cargo; built once.
need_cargo_tool() {
  if have "$1" && [ "$("$1" --version 2>/dev/null | awk '{ print $2 }')" = "$2" ]; then return 0; fi
  say "Building $3 $2 (once, some minutes)"
  # Tools that work for a second at a time: little optimised, built in a third of the time.
  local quickly=(env CARGO_PROFILE_RELEASE_OPT_LEVEL=1 CARGO_PROFILE_RELEASE_LTO=false CARGO_PROFILE_RELEASE_CODEGEN_UNITS=64
    CARGO_TARGET_DIR="$TOOLS/build" cargo install --root "$TOOLS" "$3" --version "$2" "${@:4}")
  # In a target folder of its own: cargo would throw it away otherwise, and a broken run would begin from nothing.
  # With the versions that its authors tested, unless one of them is no longer to be had.
  "${quickly[@]}" --locked || "${quickly[@]}" || die "could not build $3 $2"
  rm -rf "$TOOLS/build"
}

# A Vulkan driver that draws on the processor, so that the tests see the same adapter everywhere.
need_software_vulkan() {
  lavapipe >/dev/null || need_packages libvulkan1 mesa-vulkan-drivers
  lavapipe >/dev/null || die "Mesa's lavapipe (lvp_icd*.json) is not where Vulkan drivers are kept"
}
lavapipe() {
  local file
  for file in /usr/share/vulkan/icd.d/lvp_icd*.json /usr/local/share/vulkan/icd.d/lvp_icd*.json; do
    [ -e "$file" ] && echo "$file" && return 0
  done
  return 1
}
use_software_vulkan() {
  VK_DRIVER_FILES=$(lavapipe)
  export VK_DRIVER_FILES VK_ICD_FILENAMES=$VK_DRIVER_FILES WGPU_ADAPTER_NAME=llvmpipe
  if [ -z "${XDG_RUNTIME_DIR:-}" ]; then
    XDG_RUNTIME_DIR=$PWD/target/runtime # else the Vulkan loader complains at every start
    mkdir -p -m 700 "$XDG_RUNTIME_DIR"
    export XDG_RUNTIME_DIR
  fi
}

# A display for the window, and a hand for it.
need_display() {
  local missing=()
  have Xvfb || missing+=(xvfb)
  have xdotool || missing+=(xdotool)
  # Opened at run time, so no program's dependencies name it.
  compgen -G '/usr/lib*/libxkbcommon-x11.so.0' >/dev/null || compgen -G '/usr/lib/*/libxkbcommon-x11.so.0' >/dev/null ||
    missing+=(libxkbcommon-x11-0)
  need_packages "${missing[@]}"
}

# Both browsers, node, and the tests' packages.
need_browsers() {
  local missing=()
  have chromium || have chromium-browser || have google-chrome || [ -n "${CHROMIUM:-}" ] || missing+=(chromium)
  have firefox-esr || have firefox || [ -n "${FIREFOX:-}" ] || missing+=(firefox-esr)
  have node || missing+=(nodejs)
  have npm || missing+=(npm)
  need_packages "${missing[@]}"
  [ "$(node -p 'parseInt(process.versions.node)')" -ge 18 ] || die "node $(node --version) is too old: 18 or later is needed"
  if ! node -e '
    const wanted = require("./web/tests/package.json").dependencies;
    const version = (name) => JSON.parse(require("fs").readFileSync(`web/tests/node_modules/${name}/package.json`)).version;
    process.exit(Object.entries(wanted).every(([name, exact]) => version(name) === exact) ? 0 : 1);
  ' 2>/dev/null; then
    say "Installing the browser tests' packages"
    (cd web/tests && npm install --no-package-lock --no-fund --no-audit --loglevel=error)
  fi
}

# The page as it is shipped, into dist/; scripts/finish.sh does the last of it.
# SEASTATE_URL, where the page will be: previews of its links need whole addresses.
build_page() { NO_COLOR=true trunk build --release "$@"; }
