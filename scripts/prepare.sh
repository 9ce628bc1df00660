# Read by scripts/run, scripts/test, scripts/tidy and scripts/package: installs packages, configures,
# builds. Every message goes to standard error, so that the output of a command stays clean. Whatever
# fails says in one line what is to be done; the next call goes on where this one stopped.
#
# Expects $root, the checkout. PALPATE_PACKAGES=keep installs nothing: for machines without apt,
# or where somebody else looks after the packages. PALPATE_TIMES=FILE gets a line "STAGE SECONDS" per
# stage, and what is installed: "planned PACKAGES MB_TO_FETCH MB_ON_DISK". PALPATE_OS_RELEASE takes
# the place of /etc/os-release (for tests).

# Without a standard error messages go nowhere, and no file that is opened later takes its place.
(: >&2) 2>/dev/null || exec 2>/dev/null

say() { printf 'palpate: %s\n' "$*" >&2; }
fail() {
  say "$@"
  exit 1
}
took() { # STAGE SECONDS_AT_BEGIN
  [ -z "${PALPATE_TIMES-}" ] || echo "$1 $((SECONDS - $2))" >>"$PALPATE_TIMES"
}

# How long it took and how much it was the last time, on an empty machine: one figure.
firstTime() { # NAME
  awk -v name="$1" '$1 == name { print $2 }' "$root/cmake/first_time.txt" 2>/dev/null
}
# Free space [MB] for ordinary users where PATH lies; nothing when that can't be told.
freeMb() { # PATH
  stat -f -c '%a %S' "$1" 2>/dev/null | awk '{ printf "%d", $1 * $2 / 1e6 }'
}
# Is version A older than B? Of "4:12.2.0-3" only 12.2.0 counts.
isOlder() { # A B
  awk -v a="${1#*:}" -v b="$2" 'BEGIN {
    sub(/[^0-9.].*/, "", a)
    n = split(a, x, "."); m = split(b, y, ".")
    for (i = 1; i <= m; i++) if (x[i] + 0 != y[i] + 0) exit !(x[i] + 0 < y[i] + 0)
    exit 1
  }'
}

# The names in a package list; with a suite also the lines marked "[suite]".
packagesIn() { # LIST [SUITE]
  sed -e 's/#.*//' -e "s/\[${2:-none}\]//" "$1" | awk 'NF == 1 { print $1 }'
}
# What a list asks for at least: "NAME VERSION" of the lines with "# at least VERSION".
versionsIn() { # LIST
  sed -n 's/^\([a-z0-9.+-]*\) .*# at least \([0-9.]*\).*/\1 \2/p' "$1"
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
# Those of the names given that no installed package provides: on other systems files have moved
# between packages.
unprovided() { # NAME...
  local provided
  provided=$(dpkg-query -W -f '${db:Status-Status}, ${Provides}\n' |
    sed -n 's/^installed, *//; s/ ([^)]*)//gp; t; p')
  printf '%s\n' "$@" | awk -v provided="$provided" '
    BEGIN { n = split(provided, names, /[,\n ]+/); for (i = 1; i <= n; i++) have[names[i]] }
    !($1 in have)'
}

# "debian 12", "ubuntu 22.04"
system() {
  (. "${PALPATE_OS_RELEASE:-/etc/os-release}" 2>/dev/null && printf '%s %s' "${ID-}" "${VERSION_ID-}")
}

# Why apt failed, in one word, from what it said.
troubleOf() { # LOG
  local pattern word free
  free=$(freeMb /usr)
  if [ "${free:-20}" -lt 20 ]; then # where nothing can be written, the log says nothing
    echo space
    return
  fi
  while read -r word pattern; do
    if grep -qE "$pattern" "$1"; then
      echo "$word"
      return
    fi
  done <<'PATTERNS'
sudo ^sudo: .*(password|terminal)|not in the sudoers|not allowed to (run|execute)
space No space left on device|enough free space
interrupted dpkg was interrupted|dpkg --configure -a|--fix-broken install
locked Could not get lock|Unable to acquire the dpkg
unknown Unable to locate package|no installation candidate
network Temporary failure resolving|Could not resolve|Could not connect|Unable to connect
network Connection (failed|timed out|refused)|(Network is|host) unreachable|No route to host
PATTERNS
  echo other
}

# Runs a command of apt or dpkg as root. What it says goes to a log; on a terminal a line tells how
# far it is. No descriptor of ours: a service that a package starts must not keep the set-up's lock.
asRoot=()
aptLog=$root/build/packages.log
runAsRoot() { # COMMAND...
  LC_ALL=C.UTF-8 "${asRoot[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@" \
    </dev/null 2>&1 9>&- |
    tee "$aptLog" 2>/dev/null | awk -v terminal="$([ -t 2 ] && echo 1)" '
      /^Waiting for cache lock/ && !waited++ {
        print "palpate: waiting for another installation on this machine" > "/dev/stderr"
      }
      terminal && /^(Get:|Unpacking |Setting up )/ {
        n[substr($1, 1, 3)]++
        printf "\rpalpate: %d packages fetched, %d unpacked, %d set up ",
          n["Get"], n["Unp"], n["Set"] > "/dev/stderr"
        shown = 1
      }
      END { if (shown) printf "\n" > "/dev/stderr" }'
}
aptGet() { runAsRoot apt-get -q -y -o DPkg::Lock::Timeout=300 "$@"; }

installPackages() { # NAME...
  [ "${PALPATE_PACKAGES-}" != keep ] || return 0
  if ! command -v dpkg-query >/dev/null || ! command -v apt-get >/dev/null; then
    fail "this isn't Debian 12 (no apt-get): install what cmake/debian-packages.txt lists by the" \
      "means of this system, then call again with PALPATE_PACKAGES=keep"
  fi
  local missing=() begin=$SECONDS trouble mended=
  mapfile -t missing < <(missingPackages "$@")
  [ "${#missing[@]}" -eq 0 ] || [ "$(system)" = "debian 12" ] ||
    mapfile -t missing < <(unprovided "${missing[@]}")
  [ "${#missing[@]}" -gt 0 ] || return 0

  byHand="apt-get install --no-install-recommends ${missing[*]}"
  if [ "$(id -u)" -ne 0 ]; then
    command -v sudo >/dev/null ||
      fail "packages are missing and there is no sudo; as root: $byHand"
    asRoot=(sudo)
    [ -t 0 ] || asRoot=(sudo -n) # nobody there who could type a password
  fi
  planInstallation "${missing[@]}"
  until aptGet install --no-install-recommends "${missing[@]}"; do
    trouble=$(troubleOf "$aptLog")
    case "$mended:$trouble" in
      *interrupted*:interrupted | *updated*:unknown | *updated*:other) explainApt "$trouble" ;;
      *:interrupted)
        say "an installation was interrupted on this machine: finishing that first"
        runAsRoot dpkg --force-confdef --configure -a
        aptGet -f install
        mended+=interrupted
        ;;
      *:unknown | *:other) # package lists that are old
        say "updating the package lists"
        aptGet update || explainApt "$(troubleOf "$aptLog")"
        mended+=updated
        ;;
      *) explainApt "$trouble" ;;
    esac
  done
  took packages "$begin"
}

# What apt would do: false where it doesn't know a package.
aptKnows() { # NAME...
  LC_ALL=C.UTF-8 apt-get -o Debug::NoLocking=true --assume-no install --no-install-recommends "$@" \
    </dev/null >"$aptLog" 2>&1 9>&-
  [ "$(troubleOf "$aptLog")" != unknown ]
}

# Says what is about to be installed; ends where this system doesn't have it, or has no room for it.
planInstallation() { # NAME...
  local name wanted has unfit=() trouble packages fetch disk minutes
  if ! aptKnows "$@"; then
    say "updating the package lists"
    aptGet update || explainApt "$(troubleOf "$aptLog")"
    trouble=$(troubleOf "$aptLog") # apt-get update succeeds without a network, too
    cp "$aptLog" "$aptLog.update"
    if ! aptKnows "$@"; then
      [ "$trouble" != network ] || aptLog=$aptLog.update explainApt network
      mapfile -t unfit < <(sed -n -e "s/^E: Unable to locate package /no /p" \
        -e "s/^E: Package '\(.*\)' has no installation candidate/no \1/p" "$aptLog")
    fi
  fi
  if [ "$(system)" != "debian 12" ]; then
    while read -r name wanted; do
      has=$(apt-cache policy "$name" 2>/dev/null |
        awk '$1 == "Candidate:" && $2 != "(none)" { print $2 }')
      [ -z "$has" ] || ! isOlder "$has" "$wanted" || unfit+=("$name $has (wanted: $wanted)")
    done < <(versionsIn "$root/cmake/debian-packages.txt")
    [ "${#unfit[@]}" -eq 0 ] || fail "this is $(system), not Debian 12, and nothing was installed:" \
      "it has$(printf ' %s;' "${unfit[@]}")" \
      "with these from elsewhere call again with PALPATE_PACKAGES=keep"
    say "this is $(system), not Debian 12: packages may be others than those Palpate was tried with"
  elif [ "${#unfit[@]}" -gt 0 ]; then
    fail "apt has$(printf ' %s;' "${unfit[@]}")" \
      "do its sources (/etc/apt) name all of Debian 12, main?"
  fi

  read -r packages fetch disk < <(awk '
    function mb(number, unit) {
      gsub(",", "", number)
      return number * (unit == "GB" ? 1000 : unit == "MB" ? 1 : unit == "kB" ? 0.001 : 0)
    }
    / newly installed/ { packages = $3 }
    /^Need to get / { split($5, unit, "/"); fetch = mb($4, unit[1]) }
    /^After this operation, .* additional disk space/ { disk = mb($4, $5) }
    END { printf "%d %d %d\n", packages, fetch + 0.5, disk + 0.5 }' "$aptLog")
  minutes=
  [ "$packages" -lt 100 ] || minutes=$(firstTime packages_minutes)
  [ "$packages" -gt 0 ] || packages=
  [ -z "${PALPATE_TIMES-}" ] || [ -z "$packages" ] ||
    echo "planned $packages $fetch $disk" >>"$PALPATE_TIMES"
  local together="$packages together, $fetch MB to fetch, $disk MB on disk"
  together+="${minutes:+; $minutes min the last time}"
  say "installing $# packages${packages:+ and what they need ($together)}: $*"
  room "the packages" "$disk" /usr "$fetch" /var/cache/apt
}

# Ends with a message where there isn't enough space: MB in FOLDER, MB in FOLDER..
room() { # WHAT MB FOLDER [MB FOLDER]
  local what=$1 need=$2 where=$3 free
  shift
  while [ $# -gt 1 ]; do
    need=$1 where=$2
    # Both on one file system: they share what is free.
    if [ $# -gt 2 ] && [ "$(stat -c %d "$2" 2>/dev/null)" = "$(stat -c %d "$4" 2>/dev/null)" ]; then
      need=$((need + $3))
      shift 2
    fi
    free=$(freeMb "$where")
    [ -z "$free" ] || [ "$need" -le "$free" ] ||
      fail "not enough space: $what take $need MB in $where, $free MB are free there." \
        "Make room and call again"
    shift 2
  done
}

# Says why apt failed, and ends.
explainApt() { # TROUBLE
  local why
  case "$1" in
    sudo) fail "$(grep -i '^sudo: ' "$aptLog" | grep -vm 1 'resolve host'); as root: $byHand" ;;
    space)
      fail "no space left for the packages: $(freeMb /usr) MB are free. Make room and call again"
      ;;
    network)
      why=$(grep -m 1 -oE "(Temporary failure resolving|Could not resolve|(Could not|Unable to) connect to) [^ ]*" \
        "$aptLog")
      fail "no network: ${why:-the package archive does not answer}. Call again when there is one" \
        "(or set apt's proxy); log: $aptLog"
      ;;
    locked) fail "another program installs packages at the moment. Call again when it is done" ;;
  esac
  tail -n 20 "$aptLog" >&2
  fail "apt-get failed (its last lines stand above; all of it: $aptLog). By hand: $byHand"
}

# One set-up at a time in this checkout; unlockSetup before anything that isn't set-up.
lockSetup() {
  mkdir -p "$root/build" 2>/dev/null && exec 9>"$root/build/.setup.lock" ||
    fail "can't write to $root/build: the build needs a folder there (whose is it?)"
  flock -n 9 || {
    say "waiting for another set-up of this checkout"
    flock 9
  }
}
unlockSetup() { exec 9>&-; }

# Configures a preset where that was never done, the presets changed, or an option differs;
# anything else ninja notices by itself.
configure() { # PRESET [OPTION=VALUE...]
  local preset=$1 folder="$root/build/$1" option log begin=$SECONDS
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
  toolsFit
  mkdir -p "$folder" || fail "can't write to $folder"
  buildRoom "$preset" "${wanted[@]}"
  say "configuring build/$preset"
  log="$folder/configure.log"
  (cd "$root" && cmake --preset "$preset" "${wanted[@]/#/-D}") </dev/null >"$log" 2>&1 9>&- || {
    tail -n 40 "$log" >&2
    fail "configuring failed: $(awk '
      /^CMake Error/ { on = 1; next }
      on && NF { gsub(/^ +/, ""); text = text (text == "" ? "" : " ") $0; next }
      on && text != "" { exit }
      END { print substr(text, 1, 300) }' "$log") (log: $log)"
  }
  touch "$folder/build.ninja" # left alone by CMake when nothing in it changed
  took configuring "$begin"
}

# CMake itself and ninja, before they are called: an old CMake doesn't understand the presets.
toolsFit() {
  local tool version wanted
  for tool in cmake ninja; do
    command -v "$tool" >/dev/null || fail "$tool is missing: install what cmake/debian-packages.txt lists"
  done
  version=$(cmake --version | awk 'NR == 1 { print $3 }')
  wanted=$(versionsIn "$root/cmake/debian-packages.txt" | awk '$1 == "cmake" { print $2 }')
  [ -z "$version" ] || [ -z "$wanted" ] || ! isOlder "$version" "$wanted" ||
    fail "cmake $version is too old: $wanted or newer is wanted (Debian 12 has 3.25)"
}

# Room for what is built, for what compilers write meanwhile, and for ccache.
buildRoom() { # PRESET [OPTION=VALUE...]
  local folder="$root/build/$1" need have free here temporary=${TMPDIR:-/tmp}
  need=$(firstTime tests_mb)
  case "$* $(grep -s '^PALPATE_TESTS:' "$folder/CMakeCache.txt")" in
    "release "*PALPATE_TESTS=OFF* | "release "*PALPATE_TESTS:BOOL=OFF*)
      need=$(firstTime program_mb)
      ;;
  esac
  free=$(freeMb "$root/build")
  if [ -n "$need" ] && [ -n "$free" ] && [ "$free" -lt "$need" ]; then
    have=$(du -sm "$folder" 2>/dev/null | awk '{ print $1 }')
    room "the files of the build" $((need > ${have:-0} ? need - ${have:-0} : 0)) "$root/build"
  fi
  # Two compilers write half a gigabyte of assembler at most; a small file system in memory doesn't
  # hold it.
  here=$(freeMb "$temporary")
  if [ ! -d "$temporary" ] || [ ! -w "$temporary" ] ||
    { [ -n "$here" ] && [ "$here" -lt 500 ] && [ "$here" -lt "${free:-0}" ]; }; then
    say "$temporary can't be used or is small (${here:-0} MB free): temporary files go to build/tmp"
    mkdir -p "$root/build/tmp" || fail "can't write to $root/build"
    export TMPDIR="$root/build/tmp"
  fi
  # ccache fails where it can't write: a home that is read-only, or somebody else's.
  if command -v ccache >/dev/null; then
    here=$(ccache --get-config cache_dir 2>/dev/null) || here=
    if [ -z "$here" ] || ! mkdir -p "$here/tmp" 2>/dev/null || [ ! -w "$here" ]; then
      export CCACHE_DIR="$root/build/ccache"
    fi
  fi
}

# Builds targets (default: all), silent when there is nothing to do. $built tells whether there was.
built=0
build() { # PRESET [TARGET...]
  local preset=$1 folder="$root/build/$1" begin=$SECONDS steps minutes= status
  shift
  steps=$(ninja -C "$folder" -n "$@" 2>&1 9>&-)
  case "$steps" in
    *"no work to do."*) return 0 ;;
  esac
  buildRoom "$preset"
  steps=$(printf '%s\n' "$steps" | sed -n 's/^\[[0-9]*\/\([0-9]*\)\].*/\1/p' | tail -n 1)
  [ "${steps:-0}" -gt 20 ] || steps= # a few are CMake's own, after which there may be more
  # The first time this takes long: say how long.
  [ -x "$folder/palpate" ] || [ "$preset" != release ] || minutes=$(firstTime program_minutes)
  [ -z "$minutes" ] || minutes+=" min on $(firstTime cores) cores, this machine has $(nproc)"
  say "building build/$preset${steps:+, $steps steps}${minutes:+ (the last time from nothing: $minutes)}"
  if [ -t 2 ]; then
    NINJA_STATUS='palpate: %f of %t  ' ninja -C "$folder" "$@" </dev/null >&2 9>&-
  else
    # A line per tenth, and whatever isn't progress; all of it goes to a log.
    NINJA_STATUS='[%f/%t] ' ninja -C "$folder" "$@" </dev/null 2>&1 9>&- |
      tee "$folder/build.log" 2>/dev/null | awk '
      /^ninja: Entering directory/ { next }
      match($0, /^\[[0-9]+\/[0-9]+\] /) {
        split(substr($0, 2, RLENGTH - 3), f, "/")
        if (f[2] > 20 && int(10 * f[1] / f[2]) > tenth) {
          tenth = int(10 * f[1] / f[2])
          print "palpate: " f[1] " of " f[2] " steps"
        }
        fflush()
        next
      }
      { print; fflush() }' >&2
  fi
  status=$?
  [ "$status" -eq 0 ] || {
    local free
    free=$(freeMb "$folder")
    [ -z "$free" ] || [ "$free" -ge 20 ] ||
      fail "no space left in $folder. Make room and call again: what is built already stays"
    fail "the build failed: its first error stands above"
  }
  built=1
  took building "$begin"
}
