#!/usr/bin/env bash
# Installs what is missing and runs every test: scripts/test.sh [--only STEP]
# The GPU is Mesa's software one everywhere, so that every machine runs the same; no graphics card is needed.
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

STEPS=(format clippy clippy-page library native window page-tools page browsers)
only=
case ${1:-} in
  '') ;;
  --only) only=${2:-} ;;
  *) only=none ;;
esac
if [ -n "$only" ] && [[ ! " ${STEPS[*]} " == *" $only "* ]]; then
  printf 'usage: scripts/test.sh [--only STEP]\n  steps: %s\n' "${STEPS[*]}" >&2
  exit 2
fi

# `cargo` also builds the program that gives the browsers their reference.
format() { cargo fmt --check && echo "rustfmt: clean"; }
clippy() { cargo clippy --locked --all-targets -- -D warnings && echo "clippy: clean"; }
clippy_page() {
  cargo clippy --locked --lib --no-default-features --features app --target wasm32-unknown-unknown -- -D warnings &&
    echo "clippy (wasm): clean"
}
# The library by itself: it compiles, and nothing of GPUs, windows or files is in its tree.
library() {
  cargo clippy --locked --lib --no-default-features -- -D warnings || return 1
  local tree unwanted
  tree=$(cargo tree --locked --no-default-features --edges normal --prefix none --target all) || return 1
  if unwanted=$(grep -E '^(wgpu|naga|egui|eframe|winit|exr|image|clap|web-sys|wasm-bindgen)' <<<"$tree"); then
    printf 'the library alone depends on:\n%s\n' "$unwanted" >&2
    return 1
  fi
  echo "library: clean, $(sort -u <<<"$tree" | wc -l) packages"
}
native() { cargo test --locked --no-fail-fast; }
# One at a time: displays that start together take each other's place.
window() { cargo test --locked --test window -- --ignored --test-threads 1; }
page_tools() { (cd web/tests && node --test); }
page() { build_page && ls -l dist; }
browsers() { cargo build --locked --bin seastate && (cd web/tests && node run.mjs); }

need_rust
need_software_vulkan
need_display
need_wasm_tools
need_browsers
use_software_vulkan

failed=()
began=$SECONDS
for step in "${STEPS[@]}"; do
  [ -z "$only" ] || [ "$only" = "$step" ] || continue
  say "$step"
  start=$SECONDS
  if "${step//-/_}"; then
    note "$step: ok ($((SECONDS - start)) s)"
  else
    note "$step: FAILED ($((SECONDS - start)) s)"
    failed+=("$step")
  fi
done

if [ ${#failed[@]} -gt 0 ]; then
  say "FAILED: ${failed[*]} ($((SECONDS - began)) s)"
  exit 1
fi
say "All tests passed ($((SECONDS - began)) s)"
