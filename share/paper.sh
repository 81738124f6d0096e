#!/usr/bin/env bash
# Runs the published designs (share/experiments/paper), checks every result, recomputes the designed scenes apart
# from their designs, prints a line for each, and reports on all (`hauberk report`).
#
#   share/paper.sh [DIR] [--only NAME,NAME...] [--no-recheck] [options of `hauberk run`]
#
# Results of a design go to DIR/NAME (default: out/paper of the checkout), of its recomputation to
# DIR/NAME/recheck, the report to DIR/report. What is complete in DIR is kept, what was interrupted goes on.
# Designs run on one thread each, as many at a time as there are processors: results do not depend on it, and a
# single design cannot keep several busy all the time. With --threads N each takes N, and fewer run at a time.
# HAUBERK names the program, if not build/release's.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

bad_input() {
  echo "share/paper.sh: $1" >&2
  exit 2
}

hauberk=${HAUBERK:-$(dirname "$here")/build/release/bin/hauberk}
[[ -x $hauberk ]] || bad_input "there is no program $hauberk; build it (share/setup.sh), or name it with HAUBERK"
hauberk=$(realpath -- "$hauberk")

out=$(dirname "$here")/out/paper
if (($# > 0)) && [[ $1 != -* ]]; then
  out=$1
  shift
fi
only='' recheck=yes threads=1 options=()
while (($# > 0)); do
  case $1 in
    --only | --threads)
      (($# > 1)) || bad_input "$1: a value is missing"
      if [[ $1 == --only ]]; then only=$2; else threads=$2; fi
      shift ;;
    --only=*) only=${1#*=} ;;
    --threads=*) threads=${1#*=} ;;
    --no-recheck) recheck=no ;;
    *) options+=("$1") ;;
  esac
  shift
done
[[ $threads =~ ^[1-9][0-9]{0,3}$ ]] || bad_input "--threads: expected a number from 1 to 9999, found '$threads'"

mapfile -t names < <(basename -s .json -a "$here"/experiments/paper/*.json)
if [[ -n $only ]]; then
  IFS=, read -r -a chosen <<<"$only"
  for name in "${chosen[@]}"; do
    [[ " ${names[*]} " == *" $name "* ]] || bad_input "--only: there is no design '$name'; there are ${names[*]}"
  done
  names=("${chosen[@]}")
  if [[ -n $(printf '%s\n' "${names[@]}" | sort | uniq -d) ]]; then bad_input "--only: a design is named twice: $only"; fi
fi

# run LOG ARGUMENT...: the program with the output in LOG; of what was complete already the former LOG stands, and
# what is refused is in LOG.refused.
run() {
  local log=$1 status=0
  shift
  "$hauberk" run "$@" --threads "$threads" --quiet >"$log.new" 2>&1 || status=$?
  rm -f "$log.refused"
  if [[ $status -eq 2 ]]; then
    mv "$log.new" "$log.refused"
  elif grep -q ': complete already$' "$log.new" && [[ -e $log ]]; then
    rm "$log.new"
  else
    mv "$log.new" "$log"
  fi
  return "$status"
}

# Everything about one design, its line left in NAME.line. Returns 0 if all is well, 2 if there are no results of
# this run, 130 if it was interrupted, otherwise 1.
design() {
  local name=$1 status=0 recomputed=0 checked=passes rechecked=- start=$SECONDS interrupted=no
  trap 'interrupted=yes' TERM  # once the program is done, which gets the signal, too
  run "$out/$name.txt" "$here/experiments/paper/$name.json" -o "$out/$name" --resume \
    "${options[@]+"${options[@]}"}" || status=$?
  local seconds=$((SECONDS - start))
  [[ $status -eq 130 || $interrupted == yes ]] && return 130
  if [[ $status -ne 2 ]]; then
    "$hauberk" verify "$out/$name" >"$out/$name.verify.txt" 2>&1 || checked=FAILS
    [[ $interrupted == yes ]] && return 130
    if [[ $recheck == yes && -e $out/$name/designed.json ]]; then
      local again=("$out/$name.recheck.txt" "$out/$name/designed.json" -o "$out/$name/recheck"
        --set /solver/preset=accurate --set /solver/starts=8)
      run "${again[@]}" --resume || recomputed=$?
      # Refused: it is there, but of a former design.
      if [[ $recomputed -eq 2 ]]; then
        recomputed=0
        run "${again[@]}" --force || recomputed=$?
      fi
      [[ $recomputed -eq 130 || $interrupted == yes ]] && return 130
      rechecked=passes
      "$hauberk" verify "$out/$name/recheck" >"$out/$name.recheck.verify.txt" 2>&1 || rechecked=FAILS
    fi
  fi
  local objective='' met=''
  if [[ $status -eq 2 ]]; then
    checked=-
    cat "$out/$name.txt.refused" >&2
  else
    objective=$(sed -n 's/^objective \(.*\), [0-9]* iterations.*/\1/p' "$out/$name.txt")
    met=$(grep -m1 'targets met$' "$out/$name.txt" || true)
  fi
  printf '%-16s %-28s %-24s %10d  %-10s %-10s %d\n' "$name" "${objective:--}" "${met:--}" "$seconds" "$checked" \
    "$rechecked" "$status" >"$out/$name.line"
  [[ $status -eq 2 ]] && return 2
  [[ $status -eq 0 && $recomputed -eq 0 && $checked == passes && $rechecked != FAILS ]]
}

mkdir -p "$out"
out=$(cd "$out" && pwd)
jobs=$(($(nproc) / threads))
((jobs > 0)) || jobs=1
printf '%-16s %-28s %-24s %10s  %-10s %-10s %s\n' design objective 'targets met' seconds verify recheck status

# Every design is a process group of its own, so that an interrupt reaches the program and is waited for.
set -m
declare -A pids=()
stop() {
  trap '' INT TERM
  for pid in "${pids[@]}"; do kill -TERM -- "-$pid" 2>/dev/null || true; done
  wait || true
  exit 130
}
trap stop INT TERM

declare -A status_of=()
failed=0 started=0 printed=0 results=()
while ((printed < ${#names[@]})); do
  while ((started < ${#names[@]} && ${#pids[@]} < jobs)); do
    name=${names[started]}
    rm -f "$out/$name.line"
    design "$name" &
    pids[$!]=$!
    status_of[$name]=$!
    ((++started))
  done
  status=0 ended=''
  wait -n -p ended "${pids[@]}" || status=$?
  [[ -n $ended && $status -ne 130 ]] || stop
  unset "pids[$ended]"
  for name in "${names[@]}"; do
    if [[ ${status_of[$name]-} == "$ended" ]]; then status_of[$name]=done$status; fi
  done
  # Lines come in the order of the designs, whichever is done first.
  while ((printed < ${#names[@]})) && [[ ${status_of[${names[printed]}]-} == done* ]]; do
    name=${names[printed]} status=${status_of[${names[printed]}]#done}
    if [[ -e $out/$name.line ]]; then cat "$out/$name.line" && rm "$out/$name.line"; fi
    [[ $status -eq 0 ]] || failed=1
    [[ $status -eq 2 ]] || results+=("$name")
    ((++printed))
  done
done
set +m
trap - INT TERM

if ((${#results[@]} > 0)); then
  rechecks=()
  if [[ $recheck == yes ]]; then rechecks=(--recheck recheck); fi
  cd "$out"
  "$hauberk" report "${results[@]}" -o report --force "${rechecks[@]+"${rechecks[@]}"}" || failed=1
fi
exit "$failed"
