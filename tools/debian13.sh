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
# What has changed is to be newer than what was made of it there.
git ls-files -z --cached --others --exclude-standard | xargs -0 sh -c '
  to=$0/pydart2
  for file; do
    cmp -s "$file" "$to/$file" || { mkdir -p "$to/$(dirname "$file")" && cp "$file" "$to/$file"; }
  done' "$root"
git init --quiet "$root/pydart2" # whom tests ask for the files

[ $# -gt 0 ] || set -- demo test
# The mounts go with the process.
exec unshare --mount sh -euc '
  root=$1; shift
  mount -t proc proc "$root/proc"
  mount --rbind /dev "$root/dev"
  exec chroot "$root" env HOME=/root PATH=/usr/sbin:/usr/bin:/sbin:/bin make -C /pydart2 "$@"
' sh "$root" "$@"
