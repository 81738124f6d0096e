#!/usr/bin/env bash
# Sets up, then redesigns a chainmail so that its limits meet published targets.
#
#   share/demo.sh [DIR] [options of `hauberk run`]     results go to DIR (default: out/chainmail_c of the checkout)
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)

out=$(dirname "$here")/out/chainmail_c
if (($# > 0)) && [[ $1 != -* ]]; then
  out=$1
  shift
fi

# A page to turn the fabric by hand, where its viewer can be built.
page=()
if command -v npm >/dev/null && "$here/setup.sh" --no-build --viewer; then page=(--html); fi
"$here/setup.sh"
hauberk=$(dirname "$here")/build/release/bin/hauberk
status=0
"$hauberk" run "$here/experiments/chainmail_c.json" -o "$out" --force "${page[@]}" "$@" || status=$?

out=$(cd "$out" 2>/dev/null && pwd) || exit "$status"
echo
for plot in "$out"/*.svg; do
  [[ -e $plot ]] && echo "demo: limits before and after, as a polar plot: $plot"
done
[[ -e $out/results.json ]] && echo "demo: everything that was computed:             $out/results.json"
if [[ -e $out/report.html ]]; then
  echo "demo: the fabric, at rest and locked, to turn by hand: $out/report.html"
fi
exit "$status"
