#!/bin/sh
# usage: fetch.sh FOLDER    puts Embree 4.4.0 there and prints its library's path
#
# Debian 12 has Embree 3 only.  The wheel embreex 4.4.0.post1 on PyPI contains
# Intel's build of 4.4.0 for any x86-64 Linux with glibc 2.27 or later, without
# headers; rtcore.h is beside this script.  $EMBREE4_WHEEL, if set, is used
# instead of a download.  Exit status 77: Embree 4 is not available, for the
# reason on standard output.
folder=$1
name=embreex-4.4.0.post1-cp311-cp311-manylinux_2_27_x86_64.manylinux_2_28_x86_64.whl
sum=2cd0f7d5c6342e6247e31f700761689cae7829454d8c6de0c41e62124a023e1f

unavailable() { # REASON
    echo "no Embree 4: $1"
    exit 77
}

genuine() { # FILE
    [ "$(sha256sum "$1" 2>/dev/null | cut -d ' ' -f 1)" = $sum ]
}

library() {
    find "$folder/embreex.libs" -name 'libembree4*.so.4' 2>/dev/null | head -n 1
}

[ -n "$(library)" ] && library && exit
[ "$(uname -sm)" = 'Linux x86_64' ] || unavailable 'the wheel is for Linux on x86-64'
command -v python3 >/dev/null || unavailable 'no python3 to fetch and unpack it (make deps)'
mkdir -p "$folder" || exit 1
wheel=${EMBREE4_WHEEL:-$folder/$name}
if [ ! -e "$wheel" ]; then
    python=${BUILD:-build}/python/bin/python # of make deps
    [ -x "$python" ] || python=python3
    "$python" -m pip --version >/dev/null 2>&1 || unavailable 'no pip to fetch it (make deps)'
    "$python" -m pip --quiet --disable-pip-version-check download \
        --timeout 10 --retries 1 --no-deps --dest "$folder" \
        --only-binary :all: --implementation cp --python-version 3.11 \
        --platform manylinux_2_28_x86_64 embreex==4.4.0.post1 >/dev/null 2>&1 ||
        unavailable 'pip does not reach embreex 4.4.0.post1'
fi
genuine "$wheel" || unavailable "$wheel is not the file expected"
python3 -m zipfile -e "$wheel" "$folder/unpacked" &&
    mv "$folder/unpacked/embreex.libs" "$folder/" &&
    rm -rf "$folder/unpacked" && library
