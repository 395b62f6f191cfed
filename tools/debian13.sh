#!/bin/sh
# `make demo` and `make test`, or the targets that are named, on a bare Debian 13 in build/debian13, which debootstrap
# makes. Needs root and 8 GB. What is set up there already is not set up again.
set -eu
cd "$(dirname "$0")/.."
root=$PWD/build/debian13

if [ ! -e "$root/.complete" ]; then
  mirror=$(apt-get indextargets --format '$(REPO_URI)' | grep '/debian/*$' | head -n 1)
  rm -rf "$root"
  debootstrap --variant=minbase --include=python3,make,git,ca-certificates trixie "$root" "$mirror"
  touch "$root/.complete"
fi
for file in /etc/resolv.conf /etc/pip.conf /etc/ssl/certs/ca-certificates.crt; do
  if [ -e "$file" ]; then cp -L "$file" "$root$file"; fi
done
mkdir -p "$root/pydart2"
git ls-files -z --cached --others --exclude-standard |
  tar --create --null --files-from=- | tar --extract --directory="$root/pydart2"

[ $# -gt 0 ] || set -- demo test
# The mounts go with the process.
exec unshare --mount sh -euc '
  root=$1; shift
  mount -t proc proc "$root/proc"
  mount --rbind /dev "$root/dev"
  exec chroot "$root" env HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin make -C /pydart2 "$@"
' sh "$root" "$@"
