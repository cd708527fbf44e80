#!/usr/bin/env bash
# What trunk leaves to do for the page, as its last hook: sums of the program in index.html, headers for static hosts, and the
# worker that keeps the page for times without a network.
set -euo pipefail

top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "${TRUNK_STAGING_DIR:?run by trunk}"

# A file's sum as browsers want it.
integrity() {
  local hex
  if command -v sha384sum >/dev/null; then hex=$(sha384sum "$1"); else hex=$(shasum -a 384 "$1"); fi
  printf 'sha384-'
  # shellcheck disable=SC2059 # the format is the bytes
  printf "$(printf '%s' "${hex%% *}" | sed 's/../\\x&/g')" | base64 | tr -d '\n'
}

# In place, on every system's sed.
edit() {
  sed "$1" "$2" >"$2.new"
  mv "$2.new" "$2"
}

for part in glue wasm; do
  name=$(sed -n "s/.*<meta name=\"seastate-program\".* data-$part=\"\([^\"]*\)\".*/\1/p" index.html)
  [ -f "$name" ] || { echo "finish: index.html names no $part" >&2 && exit 1; }
  edit "s|data-$part=\"$name\"|& data-$part-integrity=\"$(integrity "$name")\"|" index.html
done

# Previews of links need whole addresses.
[ -z "${SEASTATE_URL:-}" ] || edit "s|\(property=\"og:image\" content=\"\)still.jpg|\1${SEASTATE_URL%/}/still.jpg|" index.html

files=()
for file in *; do
  [ "$file" = index.html ] || files+=("$file")
done

sum=$(integrity index.html)
list=$(printf '"%s", ' "${files[@]}")
sed "s|@FILES@|${list%, }|; s|@SUM@|${sum#sha384-}|" "$top/web/sw.js" >sw.js

# Names with a hash stay as they are for ever. The page says the same of its content, but for who may embed it: anybody.
policy=$(sed -n 's/.*http-equiv="Content-Security-Policy" content="\([^"]*\)".*/\1/p' index.html)
[ -n "$policy" ] || { echo "finish: index.html has no Content-Security-Policy" >&2 && exit 1; }
{
  printf '/*\n  Content-Security-Policy: %s; frame-ancestors *\n' "$policy"
  printf '  X-Content-Type-Options: nosniff\n  Referrer-Policy: no-referrer\n'
  printf '/\n  Cache-Control: no-cache\n/index.html\n  Cache-Control: no-cache\n/sw.js\n  Cache-Control: no-cache\n'
  for file in "${files[@]}"; do
    case $file in
      *-[0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f][0-9a-f]*) age='public, max-age=31536000, immutable' ;;
      *) age='public, max-age=3600' ;;
    esac
    printf '/%s\n  Cache-Control: %s\n' "$file" "$age"
  done
} >_headers
