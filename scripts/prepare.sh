# Read by scripts/run, scripts/test and scripts/tidy: installs packages, configures, builds.
# Every message goes to standard error, so that the output of a command stays clean.
#
# Expects $root, the checkout. PALPATE_PACKAGES=keep installs nothing: for machines without apt,
# or where somebody else looks after the packages.

say() { printf 'palpate: %s\n' "$*" >&2; }
fail() {
  say "$@"
  exit 1
}

# The names in a package list; with a suite also the lines marked "[suite]".
packagesIn() { # LIST [SUITE]
  sed -e 's/#.*//' -e "s/\[${2:-none}\]//" "$1" | awk 'NF == 1 { print $1 }'
}

# Those of the names given that aren't installed.
missingPackages() { # NAME...
  local installed
  installed=$(dpkg-query -W -f '${db:Status-Status} ${Package}\n' "$@" 2>/dev/null) || true # fails when one is unknown
  printf '%s\n' "$@" | awk -v installed="$installed" '
    BEGIN {
      n = split(installed, lines, "\n")
      for (i = 1; i <= n; i++) if (split(lines[i], f, " ") == 2 && f[1] == "installed") have[f[2]]
    }
    !($1 in have)'
}

warnUnlessDebian12() {
  local id version
  id=$(. /etc/os-release 2>/dev/null && printf %s "${ID-}")
  version=$(. /etc/os-release 2>/dev/null && printf %s "${VERSION_ID-}")
  [ "$id $version" = "debian 12" ] ||
    say "this is ${id:-an unknown system} $version, not Debian 12: packages may be missing or too old"
}

installPackages() { # NAME...
  [ "${PALPATE_PACKAGES-}" != keep ] || return 0
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    fail "this isn't Debian 12 (no apt-get): install what cmake/debian-packages.txt lists by the" \
      "means of this system, then call again with PALPATE_PACKAGES=keep"
  fi
  local missing=() asRoot=() log
  mapfile -t missing < <(missingPackages "$@")
  [ "${#missing[@]}" -gt 0 ] || return 0

  warnUnlessDebian12
  local byHand="apt-get install --no-install-recommends ${missing[*]}"
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      fail "packages are missing and there is no sudo; as root: $byHand"
    asRoot=(sudo)
    [ -t 0 ] || asRoot=(sudo -n) # nobody there who could type a password
  fi
  asRoot+=(env DEBIAN_FRONTEND=noninteractive)
  say "installing ${#missing[@]} packages: ${missing[*]}"
  local apt=("${asRoot[@]}" apt-get -q -y -o DPkg::Lock::Timeout=300)
  local install=("${apt[@]}" install --no-install-recommends "${missing[@]}")
  log=$(mktemp)
  # The first try fails where the package lists are missing or old: then, and only then, update.
  # No descriptor of ours: a service that a package starts must not keep the set-up's lock.
  if ! "${install[@]}" </dev/null >"$log" 2>&1 9>&-; then
    say "updating the package lists"
    if ! { "${apt[@]}" update && "${install[@]}"; } </dev/null >"$log" 2>&1 9>&-; then
      tail -n 20 "$log" >&2
      rm -f "$log"
      fail "apt-get failed (its last lines stand above). Is there a network? By hand: $byHand"
    fi
  fi
  rm -f "$log"
}

# One set-up at a time in this checkout; unlockSetup before anything that isn't set-up.
lockSetup() {
  mkdir -p "$root/build" || fail "can't write to $root: the build needs a folder there"
  exec 9>"$root/build/.setup.lock" || fail "can't write to $root/build"
  flock -n 9 || {
    say "waiting for another set-up of this checkout"
    flock 9
  }
}
unlockSetup() { exec 9>&-; }

# Configures a preset where that was never done, the presets changed, or an option differs;
# anything else ninja notices by itself.
configure() { # PRESET [OPTION=VALUE...]
  local preset=$1 folder="$root/build/$1" option log
  shift
  local cache="$folder/CMakeCache.txt" wanted=("$@") stale=0
  # A checkout that was moved or copied: the cache would build the old place.
  if [ -f "$cache" ] && ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache"; then
    say "the checkout was moved: configuring anew"
    rm -rf "$folder"
  fi
  [ -f "$folder/build.ninja" ] && [ "$folder/build.ninja" -nt "$root/CMakePresets.json" ] || stale=1
  for option in "${wanted[@]}"; do
    grep -q "^${option%%=*}:[A-Z]*=${option#*=}$" "$cache" 2>/dev/null || stale=1
  done
  [ "$stale" = 1 ] || return 0
  say "configuring build/$preset"
  mkdir -p "$folder"
  log="$folder/configure.log"
  (cd "$root" && cmake --preset "$preset" "${wanted[@]/#/-D}") </dev/null >"$log" 2>&1 9>&- || {
    tail -n 40 "$log" >&2
    fail "configuring failed (its last lines stand above; all of it: $log)"
  }
  touch "$folder/build.ninja" # left alone by CMake when nothing in it changed
}

# Builds targets (default: all), silent when there is nothing to do.
build() { # PRESET [TARGET...]
  local preset=$1 folder="$root/build/$1"
  shift
  case "$(ninja -C "$folder" -n "$@" 2>&1 9>&-)" in
    *"no work to do."*) return 0 ;;
  esac
  say "building build/$preset"
  ninja -C "$folder" "$@" </dev/null >&2 9>&- || fail "the build failed: its first error stands above"
}
