#!/usr/bin/env bash
# Runs the published designs (share/experiments/paper), checks every result, and prints a line for each.
#
#   share/paper.sh [DIR] [options of `hauberk run`]    results go to DIR/NAME (default: out/paper of the checkout)
#
# What is complete in DIR is kept, what was interrupted goes on. HAUBERK names the program, if not build/release's.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
hauberk=${HAUBERK:-$(dirname "$here")/build/release/bin/hauberk}

out=$(dirname "$here")/out/paper
if (($# > 0)) && [[ $1 != -* ]]; then
  out=$1
  shift
fi

failed=0
mkdir -p "$out"
printf '%-16s %-28s %-24s %10s  %-10s %s\n' design objective 'targets met' seconds verify status
for file in "$here"/experiments/paper/*.json; do
  name=$(basename "$file" .json)
  status=0
  start=$SECONDS
  "$hauberk" run "$file" -o "$out/$name" --resume --quiet "$@" >"$out/$name.new.txt" 2>&1 || status=$?
  seconds=$((SECONDS - start))
  # Of a design that was complete already the former report stands.
  if grep -q '^Design of' "$out/$name.new.txt" || [[ ! -e $out/$name.txt ]]; then
    mv "$out/$name.new.txt" "$out/$name.txt"
  else
    rm "$out/$name.new.txt"
  fi
  [[ $status -eq 130 ]] && exit 130
  checked=passes
  "$hauberk" verify "$out/$name" >"$out/$name.verify.txt" 2>&1 || checked=FAILS
  objective=$(sed -n 's/^objective \(.*\), [0-9]* iterations.*/\1/p' "$out/$name.txt")
  met=$(grep -m1 'targets met$' "$out/$name.txt" || true)
  printf '%-16s %-28s %-24s %10d  %-10s %d\n' "$name" "${objective:--}" "${met:--}" "$seconds" "$checked" "$status"
  [[ $status -eq 0 && $checked == passes ]] || failed=1
done
exit "$failed"
