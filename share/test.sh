#!/usr/bin/env bash
# Sets up, builds everything and runs all tests. Arguments go to ctest, e.g. share/test.sh -R test_host
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

share/setup.sh --no-build
# Pages are tested where their viewer can be built and a browser is there.
if command -v npm >/dev/null; then share/setup.sh --no-build --viewer || echo "test: the viewer of pages is not tested"; fi
# Exported files are judged by others' readers where these can be had.
if command -v npm >/dev/null; then
  (cd tests/judges && npm ci --loglevel=error --no-audit --no-fund --ignore-scripts) || echo "test: exported files are not judged by others"
fi
if [[ -n ${CI:-} ]]; then share/setup.sh --no-build --judges || echo "test: exported files are not sliced"; fi
cmake --preset release --log-level=WARNING
cmake --build --preset release --parallel "$(nproc)"
ctest --test-dir build/release --output-on-failure --no-tests=error --parallel 2 "$@"
