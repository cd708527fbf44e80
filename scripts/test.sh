#!/usr/bin/env bash
# Installs missing tools and runs the tests. Usage: see below.
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

# The steps of the whole run and of the quick run, in order. The step `page` runs beside the steps before it.
WHOLE=(format clippy clippy-page library page-tools native wavespectra window page browsers)
# A command that compiles a folder of shaders (`examples/shaders.rs`) and prints the registers that they need as JSON.
[ -z "${SEASTATE_SHADER_COMPILER:-}" ] || WHOLE+=(registers)
QUICK=(format clippy clippy-page library page-tools cpu passes smoke)
# Integration tests that need no GPU, or few of whose tests need one. The unit tests of the library run with them.
CPU_TESTS=(cli costs docs families heights hostile imports links shaders spectra state validation)

usage() {
  cat <<USAGE
usage: scripts/test.sh [--quick | --only STEP]
  Installs missing tools and runs every test. The GPU is Mesa's software driver: no graphics card is needed.
  --quick      the checks after a change, in minutes: format, lints, the library without features, the tests that
               need no GPU, the GPU passes, and the page in Chromium
  --only STEP  one step of the whole run (${WHOLE[*]})
               or of the quick run (${QUICK[*]:5})
USAGE
}

steps=("${WHOLE[@]}")
case ${1:-} in
  '') ;;
  --quick) steps=("${QUICK[@]}") ;;
  --only)
    steps=("${2:-}")
    [[ " ${WHOLE[*]} ${QUICK[*]} " == *" ${2:-none} "* ]] || { usage >&2 && exit 2; }
    ;;
  -h | --help) usage && exit 0 ;;
  *) usage >&2 && exit 2 ;;
esac

format() { cargo fmt --check && echo "rustfmt: clean"; }
clippy() { cargo clippy --locked --all-targets -- -D warnings && echo "clippy: clean"; }
clippy_page() {
  cargo clippy --locked --lib --no-default-features --features app --target wasm32-unknown-unknown -- -D warnings &&
    echo "clippy (wasm): clean"
}
# The library without features must compile, and must depend on no crate for GPUs, windows or files.
library() {
  cargo clippy --locked --lib --no-default-features -- -D warnings || return 1
  local tree unwanted
  tree=$(cargo tree --locked --no-default-features --edges normal --prefix none --target all) || return 1
  if unwanted=$(grep -E '^(wgpu|naga|egui|eframe|winit|exr|image|clap|web-sys|wasm-bindgen)' <<<"$tree"); then
    printf 'the library without features depends on:\n%s\n' "$unwanted" >&2
    return 1
  fi
  echo "library: clean, $(sort -u <<<"$tree" | wc -l) packages"
}
page_tools() { (cd web/tests && node --test); }
# Two test programs at a time: where the last test of one waits for a single thread, the other one has work.
native() {
  local programs status=0
  cargo test --locked --no-run || return 1
  # Everything is built: this only lists the programs.
  programs=$(CARGO_TERM_COLOR=never cargo test --locked --no-run 2>&1 | sed -n 's/^ *Executable .*(\(.*\))$/\1/p')
  [ -n "$programs" ] || return 1
  TEST_LOGS=$(mktemp -d)
  export TEST_LOGS
  xargs -d '\n' -P 2 -n 1 bash -c 'run_program "$0"' <<<"$programs" || status=1
  cargo test --locked --doc || status=1
  [ ! -e "$TEST_LOGS/failed" ] || cat "$TEST_LOGS/failed"
  rm -rf "$TEST_LOGS"
  return "$status"
}
# run_program FILE: runs a test program, and prints what it says when it has ended.
run_program() {
  local log status=0
  log=$TEST_LOGS/$(basename "$1")
  CARGO_MANIFEST_DIR=$PWD "$1" >"$log" 2>&1 || status=$?
  [ "$status" -eq 0 ] || echo "test program failed: $1" >>"$TEST_LOGS/failed"
  { flock 9 && echo "     Running $1" && cat "$log"; } 9>"$TEST_LOGS/lock"
  return "$status"
}
export -f run_program
cpu() {
  local test targets=(--lib)
  for test in "${CPU_TESTS[@]}"; do targets+=(--test "$test"); done
  cargo test --locked --no-fail-fast "${targets[@]}"
}
# A test of the command line builds the program with the features of the other tests, so that nothing is built twice.
build_program() { cargo test --locked --no-run --test cli; }
passes() { cargo test --locked --test passes; }
# The Python package wavespectra reads what Seastate writes, and the other way round. Skipped without Python or network.
wavespectra() {
  local folder=${XDG_CACHE_HOME:-$HOME/.cache}/seastate/wavespectra
  local wanted=tests/wavespectra/requirements.txt
  if ! cmp -s "$wanted" "$folder/requirements.txt"; then
    if ! { python3 -m venv --clear "$folder" && "$folder/bin/pip" install --quiet --requirement "$wanted"; }; then
      echo "wavespectra: skipped, because Python's venv or the packages cannot be had"
      return 0
    fi
    cp "$wanted" "$folder/requirements.txt"
  fi
  build_program && "$folder/bin/python" tests/wavespectra/third_opinion.py "${CARGO_TARGET_DIR:-target}/debug/seastate"
}
# One test at a time: two displays that start together may choose the same number.
window() { cargo test --locked --test window -- --ignored --test-threads 1; }
page() { build_page && ls -l dist; }
browsers() { build_program && (cd web/tests && node run.mjs); }
# A debug build of the page takes a fraction of the time.
smoke() {
  local dist=${CARGO_TARGET_DIR:-$PWD/target}/quick-page
  mkdir -p "$dist"
  NO_COLOR=true trunk build --dist "$dist" &&
    (cd web/tests && node run.mjs --dist "$dist" --browser chromium --group sea --only 'a sea is seen')
}
registers() {
  cargo run --locked --example shaders -- target/shaders &&
    $SEASTATE_SHADER_COMPILER target/shaders >target/shader-registers.json
}

need_rust
need_software_vulkan
need_display
need_wasm_tools
need_browsers
# The tests look for English texts, whatever the language of the system is.
export LC_ALL=C.UTF-8
use_software_vulkan

failed=()
began=$SECONDS
page_log= page_job=
if [[ " ${steps[*]} " == *" native "*" page "* ]]; then
  # The page has a build folder of its own, and the last minutes of its build use one core.
  page_log=$(mktemp)
  set -m # gives the job a process group of its own
  page >"$page_log" 2>&1 &
  page_job=$!
  set +m
  trap 'kill -- "-$page_job" 2>/dev/null || true; rm -f "$page_log"' EXIT
fi
finish_page() {
  local status=0
  wait "$page_job" || status=$?
  cat "$page_log"
  return "$status"
}

for step in "${steps[@]}"; do
  say "$step"
  start=$SECONDS
  run=${step//-/_}
  [ "$step" != page ] || [ -z "$page_job" ] || run=finish_page
  if "$run"; then
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
