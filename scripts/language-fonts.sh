#!/usr/bin/env bash
# Makes the fonts of Japanese and Chinese anew, with the characters that their translations use. Needs npm, and Python
# with fonttools and brotli.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT

# font PACKAGE FILE TEXT OUT: writes a font with the characters of TEXT.
font() {
  (cd "$folder" && npm pack --silent "@fontsource/$1" >/dev/null && tar xzf fontsource-"$1"-*.tgz "package/files/$2")
  "${PYTHON:-python3}" -m fontTools.ttLib.woff2 decompress --output-file "$folder/font.ttf" "$folder/package/files/$2"
  "${PYTHON:-python3}" -m fontTools.subset "$folder/font.ttf" --text="$3" --layout-features= --no-hinting \
    --output-file="assets/languages/$4"
}

font noto-sans-jp noto-sans-jp-japanese-400-normal.woff2 "$(cat assets/languages/ja.json)" ja.ttf
font noto-sans-sc noto-sans-sc-chinese-simplified-400-normal.woff2 "$(cat assets/languages/zh.json)" zh.ttf
font noto-sans-sc noto-sans-sc-chinese-simplified-400-normal.woff2 '日本語简体中文' names.ttf
