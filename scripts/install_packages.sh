#!/bin/sh
# SPDX-License-Identifier: Apache-2.0
# install_packages.sh GROUP...: installs the Debian packages of these groups (scripts/packages.txt)
# that are not there yet. Uses sudo where it is not run by root. Quick when nothing is missing.
set -eu
here=$(cd "$(dirname "$0")" && pwd)

installed() {
  # Node.js from elsewhere brings its own npm, which Debian's package would conflict with.
  case $1 in
    nodejs) command -v node >/dev/null && return 0 ;;
    npm) command -v npm >/dev/null && return 0 ;;
  esac
  dpkg-query -W -f='${db:Status-Status}\n' "$1" 2>/dev/null | grep -q '^installed$'
}

missing=
for group in "$@"; do
  for package in $(sed -n "s/^$group  *//p" "$here/packages.txt"); do
    installed "$package" || missing="$missing $package"
  done
done
[ -n "$missing" ] || exit 0

as_root=
if [ "$(id -u)" -ne 0 ]; then
  command -v sudo >/dev/null || {
    echo "These packages are missing:$missing" >&2
    echo "Install them as root, or install sudo, then run this again." >&2
    exit 1
  }
  as_root=sudo
fi
echo "Installing:$missing" >&2
export DEBIAN_FRONTEND=noninteractive
$as_root apt-get update -q
# shellcheck disable=SC2086
$as_root apt-get install -q -y --no-install-recommends $missing
