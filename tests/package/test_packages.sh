#!/bin/sh
# What is packed for those who link.  `make dist` writes the same bytes again, and
# its files build; CMake finds what make install installs, and builds the sources
# within another project.
. "$(dirname "$0")/../support/verdict.sh"
. "$(dirname "$0")/../support/installs.sh"

test_dist()
{
    tarball=$build/cylint-$version.tar.gz
    make_here dist && cp "$tarball" "$scratch/first" && make_here dist &&
        cmp "$tarball" "$scratch/first"
    verdict make_dist_writes_the_same_bytes_again $?
    tar -xzf "$tarball" -C "$scratch" &&
        git ls-tree -r --name-only HEAD | sort > "$scratch/committed" &&
        (cd "$scratch/cylint-$version" && find . ! -type d | sed 's|^\./||' | sort) |
        diff "$scratch/committed" -
    verdict make_dist_packs_the_committed_files $?
}

# The file of make dist, unpacked; CMake may have built the libraries beside it.
# With X86= each file is compiled once.
test_command()
{
    sources=$scratch/$project/build/_deps/cylint-src made=../cylint-build/build
    [ -d "$sources" ] || sources=$scratch/cylint-$version
    quiet env -u MAKEFLAGS -u MAKELEVEL $make -C "$sources" BUILD=$made \
        CC="$(command -v "${cc%% *}")" CFLAGS=-O0 X86= vectors= small= $made/cylint &&
        [ "$(echo 'ray 0 0 -5 0 0 1 cylinder 0 0 0 0 0 1 .5' | "$sources/$made/cylint" -d ,)" = cross,2,5,6 ]
    verdict its_files_build_the_command $?
}

# The project of cylint(3), with the program of cylint_scene(3) and the file of
# make dist.  The name of its folder has a space if the sources are below it, too.
project=scan
test_fetch_content()
{
    [ ! -f "$build/cylint-$version.tar.gz" ] || project='a scan'
    mkdir "$scratch/$project"
    display cylint.3 1 BUILDING > "$scratch/$project/CMakeLists.txt"
    display cylint_scene.3 1 > "$scratch/$project/scan.c"
    display cylint_scene.3 2 > "$scratch/scan.said"
    if [ -f "$build/cylint-$version.tar.gz" ]; then
        cp "$build/cylint-$version.tar.gz" "$scratch/$project"
        from=
    else
        from=-DFETCHCONTENT_SOURCE_DIR_CYLINT=$top
    fi
    quiet cmake -S "$scratch/$project" -B "$scratch/$project/build" -G 'Unix Makefiles' \
        -DCMAKE_C_COMPILER="${cc%% *}" -DCMAKE_C_FLAGS=-O0 '-DCYLINT_MAKE_FLAGS=X86=;vectors=;small=' $from &&
        quiet cmake --build "$scratch/$project/build" &&
        "$scratch/$project/build/scan" | diff "$scratch/scan.said" -
    verdict cmake_builds_the_sources_within_a_project $?
    command -v clang > /dev/null && command -v aarch64-linux-gnu-gcc > /dev/null || return
    quiet cmake -S "$scratch/$project" -B "$scratch/cross" -G 'Unix Makefiles' $from \
        -DCMAKE_SYSTEM_NAME=Linux -DCMAKE_C_COMPILER=clang -DCYLINT_MAKE=echo \
        -DCMAKE_C_COMPILER_TARGET=aarch64-linux-gnu -DCMAKE_SYSROOT=/ &&
        cmake --build "$scratch/cross" --target cylint_libraries |
        grep 'CC=[^ ]*/clang --target=aarch64-linux-gnu --sysroot=/ ' > "$scratch/said"
    verdict cmake_passes_the_target_of_a_toolchain_file $?
}

test_cmake()
{
    make_here DESTDIR="$scratch/root" PREFIX=/usr install
    verdict make_install_installs_cmake_files $? || return
    components=scene
    [ -f "$scratch/root/usr/lib/libcylint-embree.a" ] && components='scene;embree'
    mkdir "$scratch/examples"
    block c 1 > "$scratch/examples/example.c"
    block '' 1 > "$scratch/examples/example.said"
    for page in scene embree; do
        display cylint_$page.3 1 > "$scratch/examples/$page.c"
        display cylint_$page.3 2 > "$scratch/examples/$page.said"
    done
    quiet cmake -S tests/package/cmake -B "$scratch/cmake" -G 'Unix Makefiles' \
        -DCMAKE_C_COMPILER="${cc%% *}" -DCMAKE_C_FLAGS="${CFLAGS:-}" \
        -DEXAMPLES="$scratch/examples" -DCOMPONENTS="$components" \
        -DCMAKE_PREFIX_PATH="$scratch/root/usr" &&
        quiet cmake --build "$scratch/cmake"
    verdict cmake_builds_programs_with_the_components $? || return
    for program in example $(echo $components | tr ';' ' '); do
        for kind in '' -static; do
            LD_LIBRARY_PATH=$scratch/root/usr/lib "$scratch/cmake/$program$kind" |
                diff "$scratch/examples/$program.said" -
            verdict "cmake_${program}${kind}_prints_what_is_shown" $?
        done
    done
    rm "$scratch/root/usr/lib"/*.a
    quiet cmake -S tests/package/cmake -B "$scratch/shared" -G 'Unix Makefiles' \
        -DCMAKE_C_COMPILER="${cc%% *}" -DCOMPONENTS="$components" \
        -DEXAMPLES="$scratch/examples" -DCMAKE_PREFIX_PATH="$scratch/root/usr"
    verdict cmake_finds_shared_libraries_without_static_ones $?
    ! cmake -S tests/package/cmake -B "$scratch/none" -G 'Unix Makefiles' -DCOMPONENTS=wheel \
        -DEXAMPLES="$scratch/examples" -DCMAKE_PREFIX_PATH="$scratch/root/usr" \
        > "$scratch/log" 2>&1 && grep -q 'without the component' "$scratch/log"
    verdict cmake_names_a_component_that_is_missing $?
    make_here DESTDIR="$scratch/root" PREFIX=/usr uninstall &&
        [ ! -e "$scratch/root/usr/lib/cmake/cylint" ]
    verdict make_uninstall_removes_cmake_files $?
}

if git rev-parse HEAD > /dev/null 2>&1; then
    test_dist
else
    echo 'note: no repository, make dist is not tested'
fi
PATH=$PATH:$build/python/bin
if command -v cmake > /dev/null; then
    test_cmake
    test_fetch_content
else
    echo 'note: no CMake (make deps)'
fi
[ ! -d "$scratch/cylint-$version" ] || test_command
check_end
