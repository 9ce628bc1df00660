# Read by cmake/package/try_package and cmake/fresh_machine: an empty Debian in a folder, and commands inside it.
# Nothing of this machine gets into it but the network: its proxies, its name servers, its way to trust an archive.
#
# Expects $place, the folder of the new system, $release (bookworm or trixie), and $log. PALPATE_MIRROR is where Debian comes from.
mirror=${PALPATE_MIRROR:-http://deb.debian.org/debian}

say() { printf 'palpate: %s\n' "$*" >&2; }
fail() {
  say "$@" "(log: $log)"
  exit 1
}

# Runs the calling script anew with mounts and processes of its own, then AFTERWARDS (with the word "interrupted" where
# it was), and ends with its exit code. However it ends, the kernel unmounts what it mounted and ends what it started.
inOwnSpace() { # AFTERWARDS "$0" "$@"
  if [ -n "${PALPATE_OWN_SPACE-}" ]; then
    trap 'exit 130' INT TERM HUP
    return 0
  fi
  local afterwards=$1 space status
  shift
  PALPATE_OWN_SPACE=1 unshare --mount --pid --fork --kill-child "$@" &
  space=$!
  trap '{ kill -KILL "$space"; wait "$space"; } 2>/dev/null; "$afterwards" interrupted; exit 130' INT TERM HUP
  wait "$space"
  status=$?
  "$afterwards"
  exit "$status"
}

# Makes it anew from FILE, the packed result of debootstrap, which is made where it is missing, and mounts what the
# kernel makes: processes and terminals of its own.
makeEmptyDebian() { # FILE
  local base=$1
  rm -rf --one-file-system "$place"
  mkdir -p "$place" || fail "can't make $place"
  if [ -f "$base" ]; then
    tar -C "$place" -xzf "$base" || fail "$base can't be unpacked: remove it"
  else
    say "an empty Debian ($release), by debootstrap from $mirror"
    debootstrap --variant=minbase "$release" "$place" "$mirror" >>"$log" 2>&1 || fail "debootstrap failed"
    tar -C "$place" -czf "$base.part" . && mv "$base.part" "$base" || fail "can't keep $base"
  fi
  mount -t proc proc "$place/proc" && mount -t sysfs -o ro sysfs "$place/sys" &&
    mount -t devpts -o newinstance,ptmxmode=0666,gid=5,mode=620 devpts "$place/dev/pts" &&
    mkdir -p "$place/dev/shm" && mount -t tmpfs -o mode=1777 shm "$place/dev/shm" || fail "can't mount into $place"
  rm -f "$place/dev/ptmx" && ln -s pts/ptmx "$place/dev/ptmx"
  cp /etc/resolv.conf "$place/etc/resolv.conf"
  printf '127.0.0.1 localhost %s\n' "$(hostname)" >"$place/etc/hosts"
  # How apt gets out of here: proxies, and whether an archive that is a copy of another day will do.
  apt-config dump 2>/dev/null |
    grep -iE '^Acquire::(https?::proxy|http::proxy-auto-detect|check-valid-until|check-date|retries)' \
      >"$place/etc/apt/apt.conf.d/90network"
  echo force-unsafe-io >"$place/etc/dpkg/dpkg.cfg.d/trial" # it needn't survive a power cut
  # No daemon may start in here.
  printf '#!/bin/sh\nexit 101\n' >"$place/usr/sbin/policy-rc.d" && chmod +x "$place/usr/sbin/policy-rc.d"
}

# COMMAND... as root of the new system.
inside() {
  local name network=()
  for name in http_proxy https_proxy ftp_proxy no_proxy HTTP_PROXY HTTPS_PROXY NO_PROXY; do
    [ -z "${!name-}" ] || network+=("$name=${!name}")
  done
  env -i PATH=/usr/sbin:/usr/bin:/sbin:/bin HOME=/root LC_ALL=C.UTF-8 TERM=dumb DEBIAN_FRONTEND=noninteractive \
    "${network[@]}" chroot "$place" "$@" </dev/null
}
