#!/usr/bin/env bash
# The completion of bash: what it offers for lines, as bash calls it with their words.
#
#   bash_test.sh PROGRAM
set -uo pipefail
program=$1
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
failures=0

"$program" completion bash >"$work/hauberk.bash" || exit 1
bash -n "$work/hauberk.bash" || exit 1
# shellcheck source=/dev/null
source "$work/hauberk.bash"

offered() {  # what is offered for the last of the words, sorted
  COMP_WORDS=("$@")
  COMP_CWORD=$(($# - 1))
  COMPREPLY=()
  _hauberk
  ((${#COMPREPLY[@]} == 0)) || printf '%s\n' "${COMPREPLY[@]}" | LC_ALL=C sort | paste -sd ' '
}
expect() {  # WHAT WORD...
  local found
  found=$(offered "${@:2}")
  [[ $found == "$1" ]] && return
  echo "${*:2}: expected '$1', found '$found'" >&2
  failures=$((failures + 1))
}

cd "$work" || exit 1
mkdir -p folder "with space"
touch chain.json chain.so notes.txt folder/inner.json "with space/a.json"

# Commands.
expect 'report room run' hauberk r
expect '--help --version' hauberk --
expect 'conform describe list new' hauberk plugins ''
expect 'conform' hauberk plugins c
expect 'bash fish zsh' hauberk completion ''
expect '' hauberk nonsense ''

# Options, of the command alone.
expect '--threads' hauberk run --th
expect '--set --starts' hauberk room --s
expect '--seconds --section --seed --seeds' hauberk plugins conform --s
expect '--json' hauberk verify --j
expect '' hauberk verify --th
expect '--force' hauberk report --recheck x --f

# Values of options.
expect 'load_case optimizer patch shape solid' hauberk plugins new --kind ''
expect 'shape solid' hauberk plugins new --kind = s
expect 'load_case optimizer patch shape solid' hauberk plugins new --kind =
expect '/solver/preset=accurate /solver/preset=paper' hauberk run --set /solver/preset
expect 'accurate paper' hauberk run --set /solver/preset =
expect 'paper' hauberk run --set /solver/preset = p
expect 'paper' hauberk run --set = /solver/preset = p
expect '' hauberk run --threads ''
expect 'folder with space' hauberk run -o ''
expect 'folder' hauberk run --output = fo
expect 'folder/inner.json' hauberk room -o folder/
expect '--force' hauberk run -o folder --fo
expect '--force' hauberk run --set /solver/starts = 3 --fo

# Files: folders, and those of the kind.
expect 'chain.json folder with space' hauberk run ''
expect 'chain.json' hauberk check --set /solver/starts=3 ch
expect 'chain.json' hauberk verify --json c
expect 'with space/a.json' hauberk run 'with\ space/'
expect 'with space/a.json' hauberk run '"with space/'
expect 'chain.so folder with space' hauberk plugins conform ''
expect 'folder with space' hauberk plugins new --kind shape name ''
expect '' hauberk plugins new --kind shape fo
expect 'chain.json folder with space' hauberk report first second ''
expect '--budget --budget-bytes --force --help --html --output --part --plugin-path --quiet --resume --set --take-over --threads --yes -h -o' hauberk run chain.json ''

# Plugins, as the program finds them.
ids=$("$program" plugins list --json |
  python3 -c 'import json, sys; print(*sorted(p["id"] for p in json.load(sys.stdin) if "kind" in p))')
[[ $ids == *torus_union* ]] || { echo "no plugins: '$ids'" >&2; failures=$((failures + 1)); }
expect "$ids" "$program" plugins describe ''
expect 'torus_union' "$program" plugins describe torus
expect '--help --json --plugin-path -h' "$program" plugins list ''

# In a shell: bash splits the line itself.
line=$(bash --norc -ic "source '$work/hauberk.bash'; complete -p hauberk" 2>/dev/null)
[[ $line == 'complete -F _hauberk hauberk' ]] || { echo "complete: '$line'" >&2; failures=$((failures + 1)); }

((failures == 0)) || exit 1
echo "completion of bash: done"
