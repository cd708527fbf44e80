#!/usr/bin/env bash
# Trunk's last hook. It puts the checksums of the program into index.html, and writes sw.js (the service worker, which
# keeps an offline copy of the page) and _headers (HTTP headers for static hosts).
set -euo pipefail

top=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
cd "${TRUNK_STAGING_DIR:?must be set; trunk runs this script}"

# integrity FILE: its checksum in the form of an HTML integrity attribute.
integrity() {
  local hex
  if command -v sha384sum >/dev/null; then hex=$(sha384sum "$1"); else hex=$(shasum -a 384 "$1"); fi
  printf 'sha384-'
  # shellcheck disable=SC2059 # the format holds the escaped bytes
  printf "$(printf '%s' "${hex%% *}" | sed 's/../\\x&/g')" | base64 | tr -d '\n'
}

# edit COMMAND FILE: runs sed in place. The option -i differs between systems.
edit() {
  sed "$1" "$2" >"$2.new"
  mv "$2.new" "$2"
}

for part in glue wasm; do
  name=$(sed -n "s/.*<meta name=\"seastate-program\".* data-$part=\"\([^\"]*\)\".*/\1/p" index.html)
  [ -f "$name" ] || { echo "finish.sh: the $part file that index.html names is missing" >&2 && exit 1; }
  edit "s|data-$part=\"$name\"|& data-$part-integrity=\"$(integrity "$name")\"|" index.html
done

# Link previews need an absolute address.
if [ -n "${SEASTATE_URL:-}" ]; then
  edit "s|\(property=\"og:image\" content=\"\)still.jpg|\1${SEASTATE_URL%/}/still.jpg|" index.html
fi

# The message without a graphics card names the program: a link says where it is, if that is known.
if [ -n "${SEASTATE_SOURCE:-}" ]; then
  edit "s|<span id=\"program\">\(.*\)</span>|<a href=\"$SEASTATE_SOURCE\">\1</a>|" index.html
fi

# Files for other pages are not part of the offline copy.
files=()
for_others=()
for file in *; do
  # Folders hold what is fetched only when it is wanted.
  [ -d "$file" ] && continue
  case $file in
    index.html) ;;
    sea-state.* | examples.*) for_others+=("$file") ;;
    *) files+=("$file") ;;
  esac
done

sum=$(integrity index.html)
list=$(printf '"%s", ' "${files[@]}")
sed "s|@FILES@|${list%, }|; s|@SUM@|${sum#sha384-}|" "$top/web/sw.js" >sw.js

# Files with a hash in their name never change. The policy is that of index.html, and every site may embed the page.
policy=$(sed -n 's/.*http-equiv="Content-Security-Policy" content="\([^"]*\)".*/\1/p' index.html)
[ -n "$policy" ] || { echo "finish.sh: index.html has no Content-Security-Policy" >&2 && exit 1; }
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
  for file in "${for_others[@]}"; do
    # Scripts of other sites may load the element, as a module, which browsers allow only with this header.
    printf '/%s\n  Cache-Control: no-cache\n  Access-Control-Allow-Origin: *\n' "$file"
  done
} >_headers
