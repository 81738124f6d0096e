#!/usr/bin/env bash
# As an author outside of this tree: Hauberk installed into a prefix, a project of every kind from the template, built
# against that prefix, checked, and used in its experiment; then the same prefix under another name.
#
#   consumer_test.sh BUILD_FOLDER WORK_FOLDER
set -euo pipefail
build=$1 work=$2
rm -rf "$work"
mkdir -p "$work"
fail() { echo "consumer: $*" >&2; exit 1; }
# What a command prints is only of interest when it fails.
quietly() { "$@" >"$work/log.txt" 2>&1 || { cat "$work/log.txt" >&2; fail "failed: $*"; }; }

quietly cmake --install "$build" --prefix "$work/prefix"
prefix=$work/prefix
for page in man/man1/hauberk.1 bash-completion/completions/hauberk zsh/site-functions/_hauberk \
  zsh/vendor-completions/_hauberk fish/vendor_completions.d/hauberk.fish; do
  grep -q 'hauberk' "$prefix/share/$page" || fail "$page is not installed"
done
launcher=()
if command -v ccache >/dev/null; then launcher=(-D CMAKE_CXX_COMPILER_LAUNCHER=ccache); fi

project() {  # KIND NAME
  local folder=$work/$2
  quietly "$prefix/bin/hauberk" plugins new --kind "$1" "$2" "$folder"
  if grep -rnE 'plugin_name|PluginName|plugin_kind' "$folder"; then fail "$2: a mark of the template was left"; fi
  quietly cmake -S "$folder" -B "$folder/build" -D CMAKE_PREFIX_PATH="$prefix" "${launcher[@]}"
  quietly cmake --build "$folder/build"
  quietly ctest --test-dir "$folder/build" --output-on-failure
  grep -q '100% tests passed' "$work/log.txt" || fail "$2: no test ran"
}

check() {  # NAME
  local folder=$work/$1
  quietly "$prefix/bin/hauberk" plugins conform "$folder/build/plugins/$1.so"
  grep -q ' 0 failed' "$work/log.txt" || fail "$1: no summary"
  quietly "$prefix/bin/hauberk" plugins conform "$folder/build/plugins/$1.so" --filter '^descriptor$' --json
  python3 -c 'import json, sys; assert json.load(open(sys.argv[1]))["passed"]' "$work/log.txt"
  quietly "$prefix/bin/hauberk" run "$folder/experiment.json" --plugin-path "$folder/build/plugins" -o "$folder/out" \
    --force --quiet
  # The independent check knows the load cases of the program only.
  if [[ $1 != isotropic ]]; then quietly "$prefix/bin/hauberk" verify "$folder/out/results.json"; fi
}

project shape figure_eight
project load_case isotropic
project optimizer spectral
for name in figure_eight isotropic spectral; do check "$name"; done

# Nothing in the prefix knows where it is.
mv "$prefix" "$work/moved"
prefix=$work/moved
for name in figure_eight isotropic spectral; do check "$name"; done
quietly cmake -S "$work/figure_eight" -B "$work/again" -D CMAKE_PREFIX_PATH="$prefix" -D BUILD_TESTING=OFF
quietly cmake --build "$work/again"
quietly "$prefix/bin/hauberk" plugins conform "$work/again/plugins/figure_eight.so"
quietly "$prefix/bin/hauberk" plugins list
if grep -rl --include='*.cmake' "$work/prefix" "$prefix"; then fail "the package names the folder it was installed to"; fi

# Plugins of this tree that use nothing but what is installed: built outside of it, without those that are installed, and
# used in their examples.
source=$(cd "$(dirname "${BASH_SOURCE[0]}")/../.." && pwd)
outside=$work/outside
mkdir "$outside"
{
  echo 'cmake_minimum_required(VERSION 3.25)'
  echo 'project(outside LANGUAGES CXX)'
  echo 'find_package(hauberk REQUIRED)'
  for plugin in shapes/closed_tube loadcases/volumetric_periodic optimizers/nelder_mead; do
    echo "add_subdirectory(\"$source/$plugin\" \"${plugin#*/}\")"
  done
} >"$outside/CMakeLists.txt"
quietly cmake -S "$outside" -B "$outside/build" -D CMAKE_BUILD_TYPE=Release -D CMAKE_PREFIX_PATH="$prefix" "${launcher[@]}"
quietly cmake --build "$outside/build"
for plugin in shapes/closed_tube loadcases/volumetric_periodic optimizers/nelder_mead; do
  name=${plugin#*/}
  rm "$prefix/lib/hauberk/plugins/$name.so"
  quietly "$prefix/bin/hauberk" plugins conform "$outside/build/plugins/$name.so"
  quietly "$prefix/bin/hauberk" run "$source/$plugin/example.json" --plugin-path "$outside/build/plugins" \
    -o "$outside/$name" --force --quiet
done
echo "consumer: done"
