#!/usr/bin/env bash
# The completion of zsh: its syntax, and what it offers for lines that are typed in a shell. Skipped where there is no
# zsh.
#
#   zsh_test.sh PROGRAM
set -uo pipefail
program=$1
command -v zsh >/dev/null || { echo "no zsh"; exit 77; }
work=$(mktemp -d)
trap 'rm -r "$work"' EXIT
failures=0
export TERM=xterm

mkdir "$work/functions" "$work/scene"
"$program" completion zsh >"$work/functions/_hauberk" || exit 1
zsh -n "$work/functions/_hauberk" || exit 1
touch "$work/scene/chain.json" "$work/scene/notes.txt"
mkdir "$work/scene/folder"

# A shell that notes what is offered, then that this was all.
cat >"$work/setup.zsh" <<SETUP
PROMPT= ; HISTFILE= ; setopt no_list_beep
path=("$(dirname "$program")" \$path)
fpath=("$work/functions" \$fpath)
autoload -Uz compinit && compinit -u -D
compadd() {
  if [[ \${@[1,(i)(-|--)]} == *-(O|A|D)\ * ]]; then builtin compadd "\$@"; return \$?; fi
  local -a hits
  builtin compadd -A hits "\$@"
  ((\$#hits == 0)) || print -rl -- \$hits >>"$work/offered"
  builtin compadd "\$@"
}
all() { touch "$work/all" }
comppostfuncs=(all)
cd "$work/scene"
touch "$work/all"
SETUP
# Types a line and waits, at most ten seconds.
cat >"$work/type.zsh" <<TYPE
zmodload zsh/zpty || exit 77
zpty shell zsh -f -i
wait_for_all() { repeat 1000; do [[ ! -e "$work/all" ]] || return; sleep 0.01; done; exit 1 }
zpty -w shell "source $work/setup.zsh"
wait_for_all
rm "$work/all"
zpty -w -n shell "\$1"\$'\t'
wait_for_all
zpty -d shell
TYPE

expect() {  # WHAT LINE
  local found
  rm -f "$work/offered" "$work/all"
  zsh -f "$work/type.zsh" "$2" </dev/null >"$work/log" 2>&1 || { echo "$2: the shell: $(<"$work/log")" >&2; }
  touch "$work/offered"
  found=$(LC_ALL=C sort -u "$work/offered" | paste -sd ' ')
  [[ $found == "$1" ]] && return
  echo "$2: expected '$1', found '$found'" >&2
  failures=$((failures + 1))
}

expect 'report room run' 'hauberk r'
expect '--threads' 'hauberk run --th'
expect 'conform describe list new' 'hauberk plugins '
expect '--seconds --section --seed --seeds' 'hauberk plugins conform --s'
expect 'load_case optimizer patch shape solid' 'hauberk plugins new --kind '
expect '/solver/preset=accurate /solver/preset=paper' 'hauberk run --set /solver/preset'
expect 'chain.json folder' 'hauberk check '
expect 'folder' 'hauberk run -o '
expect 'torus_union' 'hauberk plugins describe torus'
((failures == 0)) || exit 1
echo "completion of zsh: done"
