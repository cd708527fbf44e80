#!/usr/bin/env bash
# Builds the page and serves it on this machine. Usage: see below.
set -euo pipefail
# shellcheck source=scripts/common.sh
source "$(dirname "${BASH_SOURCE[0]}")/common.sh"

usage() {
  cat <<'USAGE'
usage: scripts/serve.sh [--port N] [--debug]
  Installs missing tools, builds the page, and serves it until Ctrl-C. Builds it again when a source file changes.
  --port N  the address is http://localhost:N/ (default: 8080)
  --debug   a build in a fraction of the time; the page is larger and slower
USAGE
}

port=8080
mode=(--release)
while [ $# -gt 0 ]; do
  case $1 in
    --port) port=${2:-} && shift ;;
    --port=*) port=${1#*=} ;;
    --debug) mode=() ;;
    -h | --help) usage && exit 0 ;;
    *) usage >&2 && exit 2 ;;
  esac
  shift
done
[[ $port =~ ^[0-9]+$ ]] && [ "$port" -ge 1 ] && [ "$port" -le 65535 ] || die "--port needs a number from 1 to 65535"

answers() { (exec 3<>"/dev/tcp/127.0.0.1/$port") 2>/dev/null; }
if answers; then die "another program uses port $port: try --port $((port + 1))"; fi

need_rust
need_wasm_tools

say "Building the page (some minutes the first time), then serving it at http://localhost:$port/"
announce() {
  until answers; do
    kill -0 $$ 2>/dev/null || return 0
    sleep 0.5
  done
  say "The sea is at http://localhost:$port/  (stop with Ctrl-C)"
  note "The address holds the sea's state, for example http://localhost:$port/?wind=15&fetch=300&t=20"
}
announce &
export NO_COLOR=true
exec trunk serve "${mode[@]}" --port "$port"
