#!/bin/sh
# usage: sh tools/package/deb.sh TARBALL VERSION FOLDER
#
# Builds the Debian packages from a tarball of `make dist` in FOLDER and runs
# lintian.  DEBFULLNAME and DEBEMAIL name the maintainer, else git does.  Needs
# dpkg-dev, debhelper, fakeroot and lintian.
set -e
tarball=$1 version=$2 folder=$3
here=$(cd "$(dirname "$0")" && pwd)
for tool in dpkg-buildpackage dh lintian; do
    command -v $tool > /dev/null || {
        echo "deb: no $tool (apt-get install dpkg-dev debhelper fakeroot lintian)" >&2
        exit 1
    }
done
name=${DEBFULLNAME:-$(git config user.name || echo 'the libcylint authors')}
email=${DEBEMAIL:-$(git config user.email || echo "root@$(hostname)")}
committed=$(gzip -dc "$tarball" | tar -tv --full-time -f - |
    awk 'NR == 1 { print $4, $5 }')

rm -rf "$folder"
mkdir -p "$folder"
tar -xzf "$tarball" -C "$folder"
cp -r "$here/debian" "$folder/cylint-$version/debian"
cd "$folder/cylint-$version"
sed 's/^$/./; s/^/ /' LICENSE | sed 1,4d > ../license
for file in control changelog copyright; do
    sed -e "s|@VERSION@|$version|; s|@MAINTAINER@|$name <$email>|" \
        -e "s|@DATE@|$(date -R -u -d "$committed")|" \
        -e '/@LICENSE@/{' -e 'r ../license' -e 'd' -e '}' \
        "$here/debian/$file" > "debian/$file"
done
# The jobs and variables of the make that runs this are not those of the package.
unset MAKEFLAGS MAKELEVEL
DEB_BUILD_OPTIONS="${DEB_BUILD_OPTIONS:+$DEB_BUILD_OPTIONS }parallel=$(nproc)" \
    dpkg-buildpackage -us -uc -b
cd ..
ls -l ./*.deb
lintian --fail-on error,warning --info ./*.changes
