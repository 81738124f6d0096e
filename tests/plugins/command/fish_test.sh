#!/usr/bin/env bash
# The completion of fish: its syntax, and what it offers for lines. Skipped where there is no fish.
#
#   fish_test.sh PROGRAM
set -uo pipefail
program=$1
command -v fish >/dev/null || { echo "no fish"; exit 77; }
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
export HOME=$work XDG_CONFIG_HOME=$work XDG_DATA_HOME=$work
failures=0

"$program" completion fish >"$work/hauberk.fish" || exit 1
fish --no-execute "$work/hauberk.fish" || exit 1

expect() {  # WHAT LINE
  local found
  found=$(PATH=$(dirname "$program"):$PATH fish -c "source '$work/hauberk.fish'; complete -C '$2'" |
    cut -f 1 | LC_ALL=C sort | paste -sd ' ')
  [[ $found == "$1" ]] && return
  echo "$2: expected '$1', found '$found'" >&2
  failures=$((failures + 1))
}

cd "$work" || exit 1
mkdir folder
touch chain.json
expect 'report room run' 'hauberk r'
expect '--threads' 'hauberk run --th'
expect 'conform describe list new' 'hauberk plugins '
expect '--seconds --section --seed --seeds' 'hauberk plugins conform --s'
expect 'load_case optimizer patch shape solid' 'hauberk plugins new --kind '
expect '/solver/preset=accurate /solver/preset=paper' 'hauberk run --set /solver/preset'
expect 'chain.json' 'hauberk check ch'
expect 'folder/' 'hauberk run -o fo'
expect 'torus_union' 'hauberk plugins describe torus'
((failures == 0)) || exit 1
echo "completion of fish: done"
