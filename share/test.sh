#!/usr/bin/env bash
# Sets up, builds everything and runs all tests. Arguments go to ctest, e.g. share/test.sh -R test_host
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

share/setup.sh --no-build
cmake --preset release --log-level=WARNING
cmake --build --preset release --parallel "$(nproc)"
ctest --test-dir build/release --output-on-failure --no-tests=error --parallel 2 "$@"
