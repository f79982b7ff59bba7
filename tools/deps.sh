#!/bin/sh
# Installs the packages for `make check` on Debian and its descendants; with the
# argument `cross` also those for `make check-cross` and `make lint`, with
# `cluster` those for `make check-cluster` (Spark goes to $BUILD/spark), with
# `debian` none from PyPI.  It installs only missing packages, so a second run needs
# neither network nor root.
wanted='gcc g++ make mawk gawk pkg-config libmpfr-dev libgmp-dev mandoc libembree-dev
    libpng-dev zsh python3-venv python3-dev'
# gcc-multilib would be simpler for -m32, but excludes cross compilers
[ "$1" = cross ] && wanted="$wanted clang clang-19 clang-tidy clang-format-14
    cppcheck qemu-user gcc-aarch64-linux-gnu libc6-dev-arm64-cross
    gcc-s390x-linux-gnu libc6-dev-s390x-cross
    gcc-arm-linux-gnueabihf libc6-dev-armhf-cross
    gcc-riscv64-linux-gnu libc6-dev-riscv64-cross
    libc6-dev-i386 lib32gcc-$(gcc -dumpversion | cut -d . -f 1)-dev
    gcc-mingw-w64-x86-64 wine64 musl-tools tcc libsimde-dev"
[ "$1" = cluster ] && wanted="$wanted bash parallel python3 python3-venv"
[ "$1" = cluster ] && ! command -v java >/dev/null &&
    wanted="$wanted default-jre-headless"
missing=
for p in $wanted; do
    dpkg-query -W -f '${Status}' "$p" 2>/dev/null | grep -q 'ok installed' ||
        missing="$missing $p"
done
if [ -n "$missing" ]; then
    as_root=
    [ "$(id -u)" -eq 0 ] || as_root=sudo
    $as_root apt-get update -q &&
        DEBIAN_FRONTEND=noninteractive \
        $as_root apt-get install -q -y --no-install-recommends $missing || exit
fi

[ "$1" != debian ] || exit 0

# The Python package is built and tested in an environment of its own.
python=${BUILD:-build}/python
ls -d "$python"/lib/python3*/site-packages/gemmi >/dev/null 2>&1 ||
    { python3 -m venv "$python" && "$python/bin/pip" install -q \
        'scikit-build-core>=1.0' 'nanobind>=2.4' cmake ninja numpy gemmi pytest; } ||
    { rm -rf "$python" && echo 'deps: the Python package will not be tested' >&2; }

spark=${BUILD:-build}/spark
[ "$1" != cluster ] || [ -x "$spark/bin/spark-submit" ] ||
    { python3 -m venv "$spark" && "$spark/bin/pip" install -q 'pyspark==4.*' pyarrow pandas numpy; }
