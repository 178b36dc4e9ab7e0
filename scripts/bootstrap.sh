# Shared by ./run and ./test: from a bare machine to a built Polder. Sourced by bash, with the working directory at will.
root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)
build=$root/build/release
export CMAKE_BUILD_PARALLEL_LEVEL=${CMAKE_BUILD_PARALLEL_LEVEL:-$(nproc)}

say() { printf '%s\n' "$*" >&2; }
die() { say "$*"; exit 2; }

# packages SECTION...: the names listed in these sections of packages.txt, less those whose command is there already.
packages() {
  local name
  awk -v wanted=" $* " '{ sub(/#.*/, "") }
    /^\[/ { gsub(/[][ \t]/, ""); on = index(wanted, " " $0 " "); next }
    on && NF { print $1 }' "$root/packages.txt" |
    while read -r name; do
      [[ $name == *:* ]] && command -v "${name#*:}" >/dev/null || printf '%s\n' "${name%%:*}"
    done
}

# missing_packages SECTION...: those that are not installed.
missing_packages() {
  local wanted installed
  mapfile -t wanted < <(packages "$@")
  [ ${#wanted[@]} -gt 0 ] || return 0
  installed=" $(dpkg-query -W -f '${db:Status-Status}:${Package} ' "${wanted[@]}" 2>/dev/null)"
  for package in "${wanted[@]}"; do
    [[ $installed == *" installed:$package "* ]] || printf '%s\n' "$package"
  done
}

# need SECTION...: installs what is missing of these sections, or says what to ask for and stops.
need() {
  command -v dpkg-query >/dev/null && command -v apt-get >/dev/null ||
    die "Polder's set-up knows Debian and Ubuntu. Elsewhere, install the counterparts of these Debian packages:"$'\n\n'\
"$(packages "$@")"$'\n\n'"then build with: cmake --preset release && cmake --build --preset release --target polder"
  local missing as_root=()
  mapfile -t missing < <(missing_packages "$@")
  [ ${#missing[@]} -gt 0 ] || return 0
  if [ "$(id -u)" != 0 ]; then
    if command -v sudo >/dev/null && { [ -t 0 ] || sudo -n true 2>/dev/null; }; then
      as_root=(sudo)
    else
      say "Some packages are missing, and installing them takes root. Please run, or ask for:"
      die "apt-get update && apt-get install -y --no-install-recommends ${missing[*]}"
    fi
  fi
  say "Installing ${missing[*]}"
  local log
  log=$(mktemp)
  if ! { "${as_root[@]}" apt-get update -q &&
    "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive \
      apt-get install -y -q --no-install-recommends "${missing[@]}"; } </dev/null >"$log" 2>&1; then
    tail -n 20 "$log" >&2
    rm -f "$log"
    die "The packages could not be installed; the end of apt-get's output is above."
  fi
  rm -f "$log"
}

# configure ON|OFF: sets build/release up, with or without the tests, unless it is.
configure() {
  local cache=$build/CMakeCache.txt options=("-DPOLDER_TESTS=$1")
  if [ -e "$build/build.ninja" ] && grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache"; then
    if [ "$1" = OFF ] || grep -qx 'POLDER_TESTS:BOOL=ON' "$cache"; then return; fi
  else
    options+=(--fresh)
  fi
  cmake -S "$root" --preset release "${options[@]}" >&2 || exit 2
}
