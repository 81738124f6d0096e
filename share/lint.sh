#!/usr/bin/env bash
# Checks the layout of every source file (clang-format) and runs clang-tidy under .clang-tidy over every file of
# the compile database of build/release, or of the build folder named by HAUBERK_BUILD. Arguments are patterns:
# share/lint.sh kernel/contact runs clang-tidy on the files whose path contains that. Exit code 0: nothing found.
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."
build="${HAUBERK_BUILD:-build/release}"

for tool in clang-format clang-tidy; do
  command -v "$tool" >/dev/null || { echo "lint: $tool is missing; Debian has it as package $tool" >&2; exit 2; }
done
if [[ ! -f "$build/compile_commands.json" ]]; then
  echo "lint: $build has no compile_commands.json; share/setup.sh makes build/release" >&2
  exit 2
fi

git ls-files '*.cpp' '*.hpp' | xargs clang-format --dry-run --Werror

mapfile -t files < <(git ls-files '*.cpp' | grep -F "$(printf '%s\n' "${@:-.cpp}")")
# Only what the database knows: templates of plugins are built elsewhere.
mapfile -t known < <(for file in "${files[@]}"; do
  grep -qF "\"file\": \"$PWD/$file\"" "$build/compile_commands.json" && echo "$file"
done)
echo "lint: clang-tidy on ${#known[@]} files"
# The database holds g++'s warning options, some of which clang does not know.
printf '%s\n' "${known[@]}" |
  xargs -P "$(nproc)" -n 1 clang-tidy -p "$build" --quiet --warnings-as-errors='*' \
    --extra-arg=-Wno-unknown-warning-option 2> >(grep -v 'warnings generated' >&2)
