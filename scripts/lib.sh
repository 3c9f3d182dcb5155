# shellcheck shell=bash
# What scripts/demo and scripts/test share. Sourced, never run.

root=$(cd "$(dirname "${BASH_SOURCE[0]}")/.." && pwd)

say() { printf '\n== %s\n' "$*"; }

# Package names of scripts/packages/NAME.txt, without comments.
packages_of() { sed 's/#.*//' "$root/scripts/packages/$1.txt" | xargs -n 1; }

# Those of the given packages that are not installed.
missing_of() {
  local package
  for package in "$@"; do
    [[ $(dpkg-query -W -f '${db:Status-Status}' "$package" 2> /dev/null) == installed ]] || echo "$package"
  done
}

# Installs what is missing of the lists NAME...; does nothing, and asks nobody, if all is there.
install_packages() {
  if ! command -v dpkg-query > /dev/null; then
    echo "This is no Debian system: packages are not looked at. CMake will say what it does not find." >&2
    return
  fi
  local wanted missing
  mapfile -t wanted < <(for list in "$@"; do packages_of "$list"; done)
  mapfile -t missing < <(missing_of "${wanted[@]}")
  ((${#missing[@]} > 0)) || return 0
  local as_root=()
  if ((EUID != 0)); then
    if ! command -v sudo > /dev/null || { [[ ! -t 0 ]] && ! sudo -n true 2> /dev/null; }; then
      {
        echo "These packages are missing, and only root can install them:"
        echo "  apt-get install --no-install-recommends ${missing[*]}"
      } >&2
      exit 2
    fi
    as_root=(sudo)
  fi
  say "Installing ${missing[*]}"
  "${as_root[@]}" apt-get update -q || echo "The package lists could not be renewed; trying with those that are there." >&2
  "${as_root[@]}" env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends "${missing[@]}"
}

# Brings what draws charts into web/node_modules, as web/package-lock.json has it; does nothing, and asks nobody, if it is
# there. Without it, or without node, charts are plain: no reason to stop. Debian's npm will not stand beside another
# maker's node, so that neither is a package of the lists above.
install_chart_library() {
  local folder=$root/web
  [[ ! $folder/package-lock.json -nt $folder/node_modules/.package-lock.json ]] && return 0
  if ! command -v node > /dev/null && ((EUID == 0)) && command -v apt-get > /dev/null; then
    say "Installing nodejs and npm"
    env DEBIAN_FRONTEND=noninteractive apt-get install -q -y --no-install-recommends nodejs npm || true
  fi
  if ! command -v npm > /dev/null; then
    echo "There is no npm: charts will be plain. With it, run npm ci --ignore-scripts in web/ and build again." >&2
    return 0
  fi
  say "Installing what draws charts"
  (cd "$folder" && npm ci --ignore-scripts --no-audit --no-fund) ||
    echo "npm could not bring it: charts will be plain." >&2
}

# As many compilers at once as there are processors, and 2 GB of memory for each.
build_jobs() {
  local jobs memory_gb
  jobs=$(nproc)
  memory_gb=$(awk '/MemAvailable/ { print int($2 / 2097152) }' /proc/meminfo)
  ((memory_gb < jobs)) && jobs=$memory_gb
  ((jobs >= 1)) || jobs=1
  echo "$jobs"
}

# configure_and_build PRESET: quietly where there is nothing to do.
configure_and_build() {
  local preset=$1 log=$root/build/$1/configure.log
  mkdir -p "$root/build/$preset"
  if ! (cd "$root" && cmake --preset "$preset" > "$log" 2>&1); then
    cat "$log" >&2
    return 1
  fi
  (cd "$root" && cmake --build --preset "$preset" -j "$(build_jobs)")
}

# A compiler cache, where there is one, is of use to every copy of this tree.
export CCACHE_BASEDIR=$root CCACHE_NOHASHDIR=1
