#!/bin/sh
# Installs what `make check` needs on Debian and its descendants.  Only what
# is missing is asked for, so a second run needs neither network nor root.
wanted='gcc g++ make mawk gawk pkg-config libmpfr-dev libgmp-dev libgsl-dev mandoc'
missing=
for p in $wanted; do
    dpkg-query -W -f '${Status}' "$p" 2>/dev/null | grep -q 'ok installed' ||
        missing="$missing $p"
done
[ -z "$missing" ] && exit 0
as_root=
[ "$(id -u)" -eq 0 ] || as_root=sudo
$as_root apt-get update -q &&
    DEBIAN_FRONTEND=noninteractive \
    $as_root apt-get install -q -y --no-install-recommends $missing
