#!/usr/bin/env bash
# The manual page: man formats it without a warning, and it shows what it should. Skipped where there is no man.
#
#   man_test.sh PROGRAM
set -euo pipefail
program=$1
if ! command -v man >/dev/null || ! command -v groff >/dev/null; then
  echo "no man, or no groff"
  exit 77
fi
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
fail() { echo "man: $*" >&2; exit 1; }

"$program" man >"$work/hauberk.1"
man --warnings -E UTF-8 -l -Tutf8 -Z "$work/hauberk.1" >/dev/null 2>"$work/warnings"
if [[ -s $work/warnings ]]; then fail "warnings: $(<"$work/warnings")"; fi

MANWIDTH=200 man -E UTF-8 -l "$work/hauberk.1" 2>/dev/null | col -bx >"$work/text"
for text in 'hauberk - deformation limits of generalised chainmail' 'hauberk run EXPERIMENT.json [options]' \
  '-o DIR, --output DIR' "'{\"parameters\": {\"ring.R\": 5}}'" '../lib/hauberk/plugins' '130' \
  'shape|solid|load_case|patch|optimizer' 'HAUBERK_PLUGIN_PATH' 'hauberk verify out/chain'; do
  grep -qF -e "$text" "$work/text" || fail "'$text' is not on it"
done
if grep -n '`' "$work/text"; then fail "a mark of literal text was left"; fi
echo "man: done"
