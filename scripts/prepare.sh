# Read by the scripts beside it: installs packages, configures, builds. Messages go to standard error; whatever fails says in
# one line what to do, and the next call goes on where this one stopped. Expects $root, the checkout. PALPATE_PACKAGES=keep
# installs nothing, PALPATE_WERROR=ON makes warnings errors, PALPATE_TIMES=FILE gets a line "STAGE SECONDS" per stage,
# PALPATE_OS_RELEASE takes the place of /etc/os-release.

# Without a standard error messages go nowhere, and no file that is opened later takes its place.
(: >&2) 2>/dev/null || exec 2>/dev/null
say() { printf 'palpate: %s\n' "$*" >&2; }
fail() { say "$@"; exit 1; }
took() { [ -z "${PALPATE_TIMES-}" ] || echo "$1 $((SECONDS - $2))" >>"$PALPATE_TIMES"; } # STAGE SECONDS_AT_BEGIN
# How long it took and how much it was the last time, on an empty machine: one figure.
firstTime() { awk -v name="$1" '$1 == name { print $2 }' "$root/cmake/first_time.txt" 2>/dev/null; } # NAME
# Ends where PATH has no space left, which commands tell in many words or can't tell at all.
failIfFull() { # WHAT PATH
  local free
  free=$(stat -f -c '%a %S' "$2" 2>/dev/null | awk '{ printf "%d", $1 * $2 / 1e6 }')
  [ "${free:-20}" -ge 20 ] || fail "no space left for $1: $free MB are free in $2. Make room and call again"
}
# "debian 12 bookworm", "ubuntu 24.04 noble"
system() { (. "${PALPATE_OS_RELEASE:-/etc/os-release}" 2>/dev/null && echo "${ID-} ${VERSION_ID-} ${VERSION_CODENAME-}"); }

# What a list asks for, a line each: "NAME" or "NAME (>= VERSION)". Lines marked [TAG] only where TAG is the suite or the name
# of this release.
packagesIn() { # LIST [SUITE]
  awk -v tags=" ${2-} $(system) " '{
    version = match($0, /# at least [0-9.:]+/) ? " (>= " substr($0, RSTART + 11, RLENGTH - 11) ")" : ""
    sub(/#.*/, "")
    wanted = NF > 0
    for (i = 2; i <= NF; i++) if (!index(tags, " " substr($i, 2, length($i) - 2) " ")) wanted = 0
    if (wanted) print $1 version
  }' "$1"
}

# Runs a command of apt or dpkg as root; a terminal sees what it says. No descriptor of ours: a service that a package starts
# must not keep the set-up's lock.
asRoot=()
aptLog=$root/build/packages.log
runAsRoot() { # COMMAND...
  LC_ALL=C.UTF-8 "${asRoot[@]}" env DEBIAN_FRONTEND=noninteractive LC_ALL=C.UTF-8 "$@" </dev/null 2>&1 9>&- |
    tee "$aptLog" 2>/dev/null >"$([ -t 2 ] && echo /dev/stderr || echo /dev/null)"
}
aptGet() { runAsRoot apt-get -q -y -o DPkg::Lock::Timeout=300 "$@"; }

# What apt would do: 0 nothing, 1 install something, more: it can't.
planOf() { # DEPENDENCY...
  LC_ALL=C.UTF-8 apt-get -o Debug::NoLocking=true --assume-no satisfy --no-install-recommends "$@" </dev/null >"$aptLog" 2>&1 9>&-
}

installPackages() { # DEPENDENCY...
  [ "${PALPATE_PACKAGES-}" != keep ] || return 0
  local mark begin=$SECONDS plan lacks tried=
  mark="$(system): $*"
  ! grep -sqxF "$mark" "$root/build/.packages" || return 0
  command -v apt-get >/dev/null || fail "this system has no apt-get: install what cmake/debian-packages.txt lists by its own" \
    "means, then call again with PALPATE_PACKAGES=keep"
  byHand="apt-get satisfy --no-install-recommends $(printf "'%s' " "$@")"
  if [ "$(id -u)" -ne 0 ]; then
    asRoot=(sudo)
    [ -t 0 ] || asRoot=(sudo -n) # nobody there who could type a password
  fi
  planOf "$@"
  plan=$?
  if [ "$plan" -gt 1 ]; then # package lists that are old, or none yet
    requireRoot
    updateLists
    planOf "$@"
    plan=$?
    lacks=$(sed -n 's/.*Depends: //p' "$aptLog" | paste -s -d ';' | sed 's/;/; /g')
    [ "$plan" -le 1 ] || fail "this system ($(system)) lacks: ${lacks:-$(grep -m 1 '^E:' "$aptLog")}. With these from" \
      "elsewhere call again with PALPATE_PACKAGES=keep; Debian 12 and 13 have them (do apt's sources name all of main?)"
  fi
  if [ "$plan" -eq 1 ]; then
    requireRoot
    say "installing packages: $(sed -n 's/.* \([0-9]*\) newly installed.*/\1/p; s/^Need to get \(.*\) of archives.*/\1 to fetch/p
      s/^After this operation, \(.*\) of additional disk.*/\1 on disk/p' "$aptLog" | paste -s -d ';' | sed 's/;/, /g')"
    until aptGet satisfy --no-install-recommends "$@"; do
      if [ -z "$tried" ] && grep -qE 'dpkg --configure -a|--fix-broken install' "$aptLog"; then
        say "an installation was interrupted on this machine: finishing that first"
        runAsRoot dpkg --force-confdef --configure -a
        aptGet -f install
      elif [ -z "$tried" ] && grep -q ' 404 ' "$aptLog"; then # the archive has newer ones
        updateLists
      else
        explainApt
      fi
      tried=1
    done
    took packages "$begin"
  fi
  echo "$mark" >>"$root/build/.packages"
}
updateLists() {
  say "updating the package lists"
  aptGet update && ! grep -qE '^[WE]: .*(resolv|connect|unreachable)' "$aptLog" || explainApt # it may succeed without a network
}
requireRoot() {
  [ "${#asRoot[@]}" -eq 0 ] || command -v sudo >/dev/null || fail "packages are missing and there is no sudo; as root: $byHand"
}
# Says why apt failed, and ends.
explainApt() {
  local begin pattern remedy found
  failIfFull "the packages" /usr
  while IFS='~' read -r begin pattern remedy; do
    found=$(grep -v 'resolve host' "$aptLog" 2>/dev/null | grep -m 1 -oE "$pattern") && fail "$begin$found$remedy"
  done <<END
~sudo: .*~; as root: $byHand
no space left for the packages: ~([^: ][^:]*)?(No space left|enough free space).*~. Make room and call again
another program installs packages at the moment: ~(Could not get lock|Unable to acquire the dpkg).*~. Call again when it is done
no network: ~(Temporary failure|Could not|Unable to|Connection|Network is|No route)( resol| connect| unreach| to host|[ :]).*~. Call again when there is one (or set apt's proxy); log: $aptLog
END
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

# Configures a preset where that was never done, the presets changed, or an option differs; anything else ninja notices.
configure() { # PRESET [OPTION=VALUE...]
  local preset=$1 folder="$root/build/$1" cache="$root/build/$1/CMakeCache.txt" option log begin=$SECONDS stale=0
  shift
  [ -z "${PALPATE_WERROR-}" ] || set -- "$@" "PALPATE_WERROR=$PALPATE_WERROR"
  # A checkout that was moved or copied, or a home that moved to another release: the cache would build what was there.
  if [ -f "$cache" ] && { ! grep -qxF "CMAKE_HOME_DIRECTORY:INTERNAL=$root" "$cache" ||
    { [ -f "$folder/.system" ] && [ "$(cat "$folder/.system")" != "$(system)" ]; }; }; then
    say "build/$preset was made elsewhere ($(cat "$folder/.system" 2>/dev/null)): building anew"
    rm -rf "$folder"
  fi
  [ "$folder/build.ninja" -nt "$root/CMakePresets.json" ] || stale=1
  for option in "$@"; do
    grep -q "^${option%%=*}:[A-Z]*=${option#*=}$" "$cache" 2>/dev/null || stale=1
  done
  [ "$stale" = 1 ] || return 0
  for option in cmake ninja; do
    command -v "$option" >/dev/null || fail "$option is missing: install what cmake/debian-packages.txt lists"
  done
  mkdir -p "$folder" || fail "can't write to $folder"
  system >"$folder/.system"
  say "configuring build/$preset"
  log="$folder/configure.log"
  (cd "$root" && cmake --preset "$preset" "${@/#/-D}") </dev/null >"$log" 2>&1 9>&- || {
    tail -n 40 "$log" >&2
    ! grep -q 'Unrecognized "version"' "$log" || fail "$(cmake --version | head -n 1) is too old: Debian 12 has 3.25"
    fail "configuring failed: $(awk '
      /^CMake Error/ { on = 1; next }
      on && NF { gsub(/^ +/, ""); text = text (text == "" ? "" : " ") $0; next }
      on && text != "" { exit }
      END { print substr(text, 1, 300) }' "$log") (log: $log)"
  }
  touch "$folder/build.ninja" # left alone by CMake when nothing in it changed
  took configuring "$begin"
}

# Builds targets (default: all), silent when there is nothing to do. $built tells whether there was.
built=0
build() { # PRESET [TARGET...]
  local preset=$1 folder="$root/build/$1" begin=$SECONDS minutes= quiet=--quiet
  shift
  case "$(ninja -C "$folder" -n "$@" 2>&1 9>&-)" in
    *"no work to do."*) return 0 ;;
  esac
  # The first time this takes long: say how long.
  [ -x "$folder/palpate" ] || [ "$preset" != release ] || minutes=$(firstTime program_minutes)
  say "building build/$preset" \
    "${minutes:+(the last time from nothing: $minutes min on $(firstTime cores) cores, this machine has $(nproc))}"
  [ ! -t 2 ] || quiet=
  NINJA_STATUS='palpate: %f of %t  ' ninja -C "$folder" $quiet "$@" </dev/null >&2 9>&- || {
    failIfFull "the build" "$folder"
    fail "the build failed: its first error stands above"
  }
  built=1
  took building "$begin"
}
