#!/usr/bin/env bash
# Installs what is missing to build Hauberk on Debian 12, then builds it. Safe to run again.
#
#   share/setup.sh              packages, then the program and its plugins in build/release
#   share/setup.sh --no-build   packages only
#   share/setup.sh --optional   the libraries of optimizers/ipopt and optimizers/pagmo, too
#   share/setup.sh --judges     PrusaSlicer and admesh, before which tests bring exported files
#   share/setup.sh --viewer     what `hauberk export` to HTML needs, too: with node and npm, from share/web's lock file
set -euo pipefail
cd "$(dirname "${BASH_SOURCE[0]}")/.."

packages=(
  g++ cmake ninja-build
  libeigen3-dev                     # vectors and matrices
  libboost1.81-dev                  # plugin loading, intervals (1.74, the default, is too old)
  libboost-json1.81-dev libboost-program-options1.81-dev
  libsuitesparse-dev                # CHOLMOD
  libnlopt-dev                      # optimizers/nlopt
  libfmt-dev
  nettle-dev                        # SHA-256
  pybind11-dev python3-dev python3-numpy  # import hauberk; left out without them
  libzip-dev libpng-dev libexpat1-dev # 3MF and PNG, written and read; the program is built without them, too
  libgtest-dev python3-jsonschema   # tests only
  libbenchmark-dev                  # tests/bench only
)
optional_packages=(
  coinor-libipopt-dev pkg-config    # optimizers/ipopt
)

usage() { sed -n '2,8s/^# \{0,1\}//p' "${BASH_SOURCE[0]}"; }
build=yes optional=no judges=no viewer=no
for argument in "$@"; do
  case $argument in
    --no-build) build=no ;;
    --optional) optional=yes ;;
    --judges) judges=yes ;;
    --viewer) viewer=yes ;;
    -h | --help) usage; exit 0 ;;
    *) echo "setup: unknown option '$argument'" >&2; usage >&2; exit 2 ;;
  esac
done

missing_packages() {
  local package
  for package in "${packages[@]}"; do
    # "ok installed": a removed package whose settings were kept does not count.
    [[ $(dpkg-query -W -f='${Status}' "$package" 2>/dev/null) == *"ok installed" ]] || echo "$package"
  done
}

as_root() {
  if [[ $(id -u) == 0 ]]; then
    "$@"
  elif ! command -v sudo >/dev/null; then
    echo "setup: not root, and there is no sudo; run as root: $*" >&2
    exit 1
  elif [[ -t 0 ]]; then
    sudo "$@"
  else
    sudo -n "$@"  # nobody there to type a password
  fi
}

install_packages() {
  local quiet=(env DEBIAN_FRONTEND=noninteractive apt-get -qq -o Dpkg::Use-Pty=0)
  # --no-remove: Boost 1.81 cannot be installed beside the development files of another Boost.
  local install=("${quiet[@]}" install --yes --no-remove --no-install-recommends "$@")
  if apt-cache show "$@" >/dev/null 2>&1 && as_root "${install[@]}"; then return; fi
  echo "setup: package lists are missing or old: apt-get update"
  as_root "${quiet[@]}" update
  if as_root "${install[@]}"; then return; fi
  echo "setup: apt-get could not install: $*" >&2
  echo "setup: on Debian 12, if it would remove libboost1.74-dev or the like, remove that first" >&2
  exit 1
}

# pagmo (optimizers/pagmo) where its package can be installed. On Debian 12 it wants another Boost: then its library is
# installed, and its headers and those of that Boost are unpacked where share/cmake/FindPagmo.cmake finds them.
install_pagmo() {
  if [[ -f build/pagmo/usr/include/pagmo/pagmo.hpp || -f /usr/include/pagmo/pagmo.hpp ]]; then return; fi
  if apt-get -qq --simulate --no-remove install libpagmo-dev >/dev/null 2>&1; then
    install_packages libpagmo-dev
    return
  fi
  echo "setup: unpacking the headers of pagmo in build/pagmo"
  install_packages libpagmo8 libboost-serialization1.74.0
  local folder package
  folder=$(mktemp -d)
  (cd "$folder" && apt-get -qq download libpagmo-dev libboost1.74-dev)
  mkdir -p build/pagmo
  for package in "$folder"/*.deb; do dpkg-deb --fsys-tarfile "$package" | tar -x -C build/pagmo ./usr/include; done
  rm -r "$folder"
}

if [[ $optional == yes ]]; then packages+=("${optional_packages[@]}"); fi
if [[ $judges == yes ]]; then packages+=(prusa-slicer admesh); fi
if command -v dpkg-query >/dev/null && command -v apt-get >/dev/null; then
  mapfile -t missing < <(missing_packages)
  if ((${#missing[@]} == 0)); then
    echo "setup: all packages are there"
  else
    echo "setup: installing ${missing[*]}"
    install_packages "${missing[@]}"
  fi
  if [[ $optional == yes ]]; then install_pagmo; fi
else
  echo "setup: no Debian package manager; these must be there already: ${packages[*]}"
fi

# The script of pages (share/web), into share/web/build. Nothing but pages needs it.
build_viewer() {
  if ! command -v npm >/dev/null; then
    echo "setup: the viewer of pages needs node and npm (packages nodejs, npm); everything else works without it" >&2
    return 1
  fi
  echo "setup: building the viewer of pages in share/web/build"
  if ! (cd share/web && npm ci --loglevel=error --no-audit --no-fund --ignore-scripts &&
        npm run --silent build -- --log-level=warning); then
    echo "setup: the viewer of pages could not be built (npm, above); everything else works without it" >&2
    return 1
  fi
}
if [[ $viewer == yes ]]; then build_viewer; fi

if [[ $build == yes ]]; then
  echo "setup: building in build/release"
  cmake --preset release --log-level=WARNING
  cmake --build --preset release --parallel "$(nproc)" --target program
  echo "setup: done: build/release/bin/hauberk"
fi
