# shellcheck shell=bash disable=SC2034
# What ./check and ./demo share; sourced by them, from bash, with `set -euo pipefail` in force.
root=$(cd -- "$(dirname -- "${BASH_SOURCE[0]}")/.." && pwd)
cd "$root" || exit
build=$root/build
mkdir -p "$build"

# One job a core, but no more than one a gigabyte: a compiler that is killed says nothing useful.
jobs=$(nproc)
memory_gb=$(awk '/^MemAvailable:/ { print int($2 / 1048576) }' /proc/meminfo 2>/dev/null || true)
if [[ -n $memory_gb && $memory_gb -lt $jobs ]]; then jobs=$((memory_gb > 0 ? memory_gb : 1)); fi

began=$SECONDS
elapsed() { printf '%d min %02d s' $(((SECONDS - began) / 60)) $(((SECONDS - began) % 60)); }

# say WHAT: names the step that begins.
say() { printf '\n== %s (%s)\n' "$1" "$(elapsed)"; }

# configure PRESET [OPTIONS]: a build folder that was made for another place starts anew.
configure() {
  local preset=$1 folder=$build fresh=()
  shift
  [[ $preset == release ]] || folder=$build/$preset
  if [[ -f $folder/CMakeCache.txt ]] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$folder/CMakeCache.txt"; then
    fresh=(--fresh)
  fi
  cmake --preset "$preset" "${fresh[@]}" "$@"
}
