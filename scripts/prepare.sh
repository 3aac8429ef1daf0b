# SPDX-License-Identifier: LGPL-2.1-or-later
# Sourced by ./demo and ./test from the repository's root: installs what is
# missing, configures and builds. Needs Debian 12; no network if all is there.
set -euo pipefail

# A container's root may start MPI ranks, and more of them than there are cores.
export OMPI_ALLOW_RUN_AS_ROOT=1 OMPI_ALLOW_RUN_AS_ROOT_CONFIRM=1
export OMPI_MCA_rmaps_base_oversubscribe=1

packages=(g++ cmake ninja-build git ca-certificates openmpi-bin
  libdeal.ii-dev libeigen3-dev trilinos-all-dev libhdf5-openmpi-dev
  nlohmann-json3-dev libcli11-dev libgtest-dev libbenchmark-dev)

fail()
{
  printf '%s: %s\n' "$(basename "$0")" "$1" >&2
  exit 1
}

install_missing()
{
  local missing=() package
  for package in "${packages[@]}"; do
    [[ "$(dpkg-query -W -f '${db:Status-Status}' "$package" 2>/dev/null)" == installed ]] ||
      missing+=("$package")
  done
  ((${#missing[@]})) || return 0

  local as_root=()
  if ((EUID != 0)); then
    command -v sudo >/dev/null ||
      fail "these packages are missing, and neither root nor sudo is at hand to install them: ${missing[*]}"
    as_root=(sudo)
  fi
  echo "Installing: ${missing[*]}"
  "${as_root[@]}" apt-get -q update ||
    fail "the package lists cannot be fetched (is there a network?); still missing: ${missing[*]}"
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
    apt-get -q install -y --no-install-recommends "${missing[@]}" ||
    fail "these packages cannot be installed (Debian 12 has them all): ${missing[*]}"
}

# A unit that includes deal.II takes up to 1.5 GB to compile.
parallel_jobs()
{
  local memory_kb jobs cores
  memory_kb=$(awk '/^MemAvailable:/ { print $2 }' /proc/meminfo)
  jobs=$((memory_kb / 1500000))
  cores=$(nproc)
  ((jobs > cores)) && jobs=$cores
  ((jobs > 3)) && jobs=3
  ((jobs < 1)) && jobs=1
  echo "$jobs"
}

# build [target...]: everything if none is named
build()
{
  command -v dpkg-query >/dev/null || fail "this needs Debian 12 or a distribution made of its packages"
  install_missing
  cmake --preset release
  ninja -C build/release -j "$(parallel_jobs)" "$@"
}
