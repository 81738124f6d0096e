#!/usr/bin/env bash
# Builds and runs all benchmarks (tests/bench), stores the run, prints a table, and compares it with an earlier one.
#
#   share/bench.sh [--out DIR] [--compare EARLIER.json] [--filter REGEX] [--repetitions N]
#
#   --out DIR               the run goes to DIR/bench.json (default: out/bench of the checkout)
#   --compare EARLIER.json  another such file, for instance share/bench/baseline.json
#   --filter REGEX          only benchmarks whose name matches; names are those of the table
#   --repetitions N         passes through all benchmarks (default 5; times are judged from 3 on)
#
# HAUBERK_BENCH names the benchmark program, which is then not built. Exit code 0: done; 1: a benchmark failed, became
# slower by more than the noise and 10 per cent, or counts more work; 2: bad input. See share/doc/speed.md.
set -euo pipefail
here=$(cd "$(dirname "${BASH_SOURCE[0]}")" && pwd)
root=$(dirname "$here")

bad_input() {
  echo "share/bench.sh: $1" >&2
  exit 2
}

out=$root/out/bench earlier='' regex='' repetitions=5
while (($# > 0)); do
  case $1 in
    -h | --help) sed -n '2,12s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; exit 0 ;;
    --out | --compare | --filter | --repetitions)
      (($# > 1)) || bad_input "$1: a value is missing"
      case $1 in
        --out) out=$2 ;;
        --compare) earlier=$2 ;;
        --filter) regex=$2 ;;
        --repetitions) repetitions=$2 ;;
      esac
      shift ;;
    *) bad_input "unknown option '$1'; there are --out, --compare, --filter and --repetitions" ;;
  esac
  shift
done
[[ $repetitions =~ ^[1-9][0-9]{0,2}$ ]] ||
  bad_input "--repetitions: expected a number from 1 to 999, found '$repetitions'"

raw=$(mktemp -d)
trap 'rm -rf "$raw"' EXIT
if [[ -n $earlier ]]; then
  # A copy: it may be the file that is about to be replaced. Compared with itself, it is either a run or bad input.
  python3 -B "$here/bench_compare.py" "$earlier" "$earlier" >/dev/null || exit 2
  cp -- "$earlier" "$raw/earlier.json"
fi
mkdir -p -- "$out" 2>/dev/null || bad_input "--out: cannot make the folder '$out'"

bench=${HAUBERK_BENCH:-}
if [[ -z $bench ]]; then
  "$here/setup.sh" --no-build
  (cd "$root" && cmake --preset release --log-level=WARNING &&
    cmake --build --preset release --parallel "$(nproc)" --target bench)
  bench=$root/build/release/bin/tests/bench
fi
[[ -x $bench ]] || bad_input "there is no program '$bench'"

list=$("$bench" --benchmark_list_tests "--benchmark_filter=$regex") ||
  bad_input "--filter: no benchmark matches '$regex'"
commit=$(git -C "$root" describe --always --abbrev=12 --exclude='*' --dirty=' with changes' 2>/dev/null) ||
  commit=unknown
load=$(cut -d' ' -f1-3 /proc/loadavg 2>/dev/null) || load=unknown
echo "bench: $(wc -l <<<"$list") benchmarks, $repetitions times, at $commit; load average $load"

files=()
# Whole passes rather than repetitions in a row: other load comes and goes, and every process has its own layout.
for ((k = 1; k <= repetitions; ++k)); do
  echo "bench: pass $k of $repetitions"
  files+=("$raw/$k.json")
  "$bench" "--benchmark_filter=$regex" --benchmark_min_time=0.1 "--benchmark_out=$raw/$k.json" \
    --benchmark_out_format=json >"$raw/log" 2>&1 || { cat "$raw/log" >&2; exit 1; }
done
python3 -B "$here/bench_record.py" --out "$out/bench.json" --commit "$commit" --filter "$regex" "${files[@]}"
echo "bench: stored in $out/bench.json"
if [[ -n $earlier ]]; then
  echo
  python3 -B "$here/bench_compare.py" "$raw/earlier.json" "$out/bench.json"
fi
