#!/bin/sh
# What make install puts into a scratch folder works: the README's example compiles
# and links with it, the README's commands run, and uninstall removes it.  The
# library also compiles without the Makefile.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
. "$(dirname "$0")/../support/installs.sh"
root=$scratch/root
lib=$root/usr/lib
major=${version%%.*}
pkg_config=$(command -v pkg-config) || echo 'note: no pkg-config, the .pc files are not read'

make_in_root() { make_here DESTDIR="$root" PREFIX=/usr "$1"; }

# none FOUND VERDICT: passes if FOUND is empty.
none()
{
    [ -z "$1" ] || { echo "found: $1"; false; }
    verdict "$2" $?
}

test_install()
{
    (umask 077 && make_in_root install)
    verdict install_succeeds $?
    none "$(find "$root" ! -perm -444)" everybody_may_read_what_is_installed
    none "$(for f in bin/cylint lib/libcylint.a lib/libcylint.so lib/libcylint.so.$major \
        lib/libcylint.so.$version lib/libcylint-scene.a lib/libcylint-scene.so.$major \
        lib/pkgconfig/cylint.pc lib/pkgconfig/cylint-scene.pc share/cylint/autumn.awk \
        share/man/man1/cylint.1 share/man/man7/cylint.7 share/doc/cylint/README.md \
        share/doc/cylint/LICENSE share/doc/cylint/CHANGES.md \
        share/bash-completion/completions/cylint share/zsh/site-functions/_cylint \
        share/bash-completion/completions/cylint-render share/man/man1/cylint-render.1 \
        $([ ! -x "$build/cylint-render" ] || echo bin/cylint-render) \
        $(printf 'include/cylint%s.h share/man/man3/cylint%s.3 ' '' '' _methods _methods \
            _scene _scene _distance _distance _pieces _pieces); do
        [ -s "$root/usr/$f" ] || echo "no $f"
    done)" install_puts_every_file_in_its_place
    none "$(grep -l '@[A-Z_]*@' "$lib"/pkgconfig/*.pc)" the_pc_files_are_filled_in
    "$root/usr/bin/cylint" --version | grep -q -F "$version"
    verdict the_installed_command_prints_the_version $?
    awk -v trees=1 -f "$root/usr/share/cylint/autumn.awk" > "$scratch/forest" &&
        [ "$(wc -l < "$scratch/forest")" -gt 1000 ] && echo 'ray 0 0 9  0 0 -1' |
        "$root/usr/bin/cylint" -s "$scratch/forest" > /dev/null
    verdict the_installed_forest_is_a_scene $?
}

# What a debugger needs fills nine tenths of the built files.
test_strip()
{
    [ -z "$(nm "$root/usr/bin/cylint" 2> /dev/null)" ] &&
        ! grep -l '\.debug_info' "$root/usr/bin/cylint" "$lib"/*.a "$lib"/*.so
    verdict installed_files_are_stripped $?
    make_here DESTDIR="$scratch/whole" PREFIX=/usr STRIP=: install &&
        cmp "$build/cylint" "$scratch/whole/usr/bin/cylint" &&
        cmp "$build/libcylint.a" "$scratch/whole/usr/lib/libcylint.a" &&
        cmp "$build/libcylint.so" "$scratch/whole/usr/lib/libcylint.so"
    verdict STRIP_chooses_the_program_that_strips $?
}

# The flags of the installed .pc files of $packages; without pkg-config this
# function reads them.
flags()
{
    if [ "$pkg_config" ]; then
        PKG_CONFIG_LIBDIR=$lib/pkgconfig PKG_CONFIG_SYSROOT_DIR=$root \
            PKG_CONFIG_ALLOW_SYSTEM_CFLAGS=1 PKG_CONFIG_ALLOW_SYSTEM_LIBS=1 \
            pkg-config "$@" ${packages:-cylint}
    else
        echo "-I$root/usr/include -L$lib $(printf -- '-l%s ' $packages) -lcylint"
    fi
}

# cylint-scene needs the library that was built with it.
test_pkg_config()
{
    [ "$pkg_config" ] || return 0
    flags --cflags --libs --define-variable=prefix=/moved |
        grep -q -e "-I$root/moved/include -L$root/moved/lib -lcylint"
    verdict the_pc_files_move_with_the_prefix $?
    mkdir "$scratch/older" &&
        sed 's/^Version: .*/Version: 0.0.9/' "$lib/pkgconfig/cylint.pc" > "$scratch/older/cylint.pc" &&
        PKG_CONFIG_LIBDIR=$lib/pkgconfig pkg-config --exists cylint-scene &&
        ! PKG_CONFIG_LIBDIR=$scratch/older:$lib/pkgconfig pkg-config --exists cylint-scene
    verdict another_version_of_the_library_is_refused $?
}

# archives: the static libraries of $packages and their dependencies.
archives()
{
    [ -z "$packages" ] || printf "$lib/lib%s.a " $packages
    echo "$lib/libcylint.a"
    case $packages in
    *embree*) echo -lembree3 -pthread ;;
    *scene*) echo -pthread ;;
    esac
}

# example NAME LINKING COMPILER FLAGS...: the program $scratch/example.c compiles and
# prints $scratch/example.said.
example()
{
    name=$1
    case $2 in
    static) with="$(flags --cflags) $(archives) -lm" ;;
    shared) with=$(flags --cflags --libs) ;;
    esac
    shift 2
    rm -f "$scratch/example"
    [ -s "$scratch/example.said" ] &&
        quiet "$@" -Wall -Wextra -Wpedantic -Werror -o "$scratch/example" \
            "$scratch/${program:-example.c}" $with &&
        LD_LIBRARY_PATH=$lib "$scratch/example" > "$scratch/said" &&
        diff "$scratch/example.said" "$scratch/said"
    verdict "$name" $?
}

test_example()
{
    block c 1 > "$scratch/example.c"
    block '' 1 > "$scratch/example.said"
    cp "$scratch/example.c" "$scratch/example.cc"
    for linking in static shared; do
        example "the_readmes_example_as_c_$linking" $linking $cc -std=c99
        program=example.cc
        example "the_readmes_example_as_cxx_$linking" $linking $cxx -std=c++11
        program=
    done
}

# What C++ programs write, after the macros of Windows: the headers cause no warning
# and no error.
test_cxx()
{
    cat > "$scratch/user.cc" << 'END'
#define near
#define far
#define small char
#define min(a, b) ((a) < (b) ? (a) : (b))
#include <cylint_methods.h>
#include <cylint_scene.h>
#include <cylint_scene.h>
#include <cylint_embree.h>
size_t user(const cylint_scene *scene, const double *point, cylint_closest *closest);
size_t user(const cylint_scene *scene, const double *point, cylint_closest *closest)
{
    cylint_columns columns = {};
    size_t n = cylint_scene_closest(scene, point, 1, CYLINT_WANT_PART | CYLINT_SIGNED, closest);
    return columns.t0 == 0 && n != CYLINT_NO_ROOM;
}
END
    for standard in 98 11 2a; do
        quiet $cxx -std=c++$standard -Wall -Wextra -Wpedantic -Wconversion -Wsign-conversion -Wshadow \
            -Wold-style-cast -Wundef -Werror -Iinclude -fsyntax-only "$scratch/user.cc"
        verdict "the_headers_serve_cxx_$standard" $?
    done
    cat > "$scratch/first.cc" << 'END'
#include <cylint.h>
#include <cstring>
static const char *const first = cylint_kernels_in_use();
int main() { return std::strcmp(first, cylint_kernels_name(0)); }
END
    quiet $cxx -Iinclude -o "$scratch/first" "$scratch/first.cc" $(archives) -lm &&
        "$scratch/first"
    verdict static_objects_of_cxx_use_the_best_kernels $?
}

# The README's lines in a home where only the system's folders are known: the
# linked example runs and its manual is found.  After that make install prints no
# lines.
test_readme_install()
{
    [ "$pkg_config" ] || return 0
    home=$scratch/home
    mkdir "$home"
    cp "$scratch/example.c" "$home"
    cp README.md tools/install_hints.sh "$home"
    { echo "make() { (cd '$top' && command $make -s --no-print-directory \
          BUILD='${BUILD:-build}' CC='$cc' CXX='$cxx' \"\$@\"); }"
      echo "cc() { command $cc \"\$@\"; }"
      block sh 1
      echo 'command -v cylint'
      echo 'man -w cylint 2>/dev/null || echo $MANPATH'
      echo 'make install PREFIX=$HOME/.local'; } > "$home/lines"
    (cd "$home" && env -i HOME="$home" PATH=/usr/local/bin:/usr/bin:/bin \
        ${CXX17+CXX17="$CXX17"} sh lines) > "$scratch/said" 2> "$scratch/log"
    { echo 'To use what was installed, set:'
      echo "    export PATH=$home/.local/bin:\$PATH"
      echo "    export PKG_CONFIG_PATH=$home/.local/lib/pkgconfig:\$PKG_CONFIG_PATH"
      echo "    export LD_LIBRARY_PATH=$home/.local/lib\${LD_LIBRARY_PATH:+:\$LD_LIBRARY_PATH}"
      cat "$scratch/example.said"
      echo "$home/.local/bin/cylint"; } > "$scratch/expected"
    grep -v "^install\|^ln\|MANPATH\|^$home/.local/share/man" "$scratch/said" |
        diff "$scratch/expected" - && grep -q "$home/.local/share/man" "$scratch/said"
    verdict the_readmes_lines_install_and_run_a_linked_example $? || cat "$scratch/log"
}

# The printed lines work for a folder that the system does not search.
test_hints()
{
    at=$scratch/else/where
    env -i PATH=/usr/bin:/bin sh tools/install_hints.sh "$at/bin" "$at/lib" \
        "$at/man" > "$scratch/hints"
    [ "$(grep -c '^    export [A-Z_]*=' "$scratch/hints")" -eq 4 ]
    verdict four_lines_for_a_folder_outside_all_paths $?
    { sed 1d "$scratch/hints"
      echo "exec sh tools/install_hints.sh $at/bin $at/lib $at/man"; } > "$scratch/again"
    [ -z "$(env -i PATH=/usr/bin:/bin sh "$scratch/again")" ]
    verdict no_lines_if_all_paths_are_set $?
}

# shows PAGE HEADER: the manual's synopsis shows $scratch/head, of the header.
shows()
{
    display "$1" 1 SYNOPSIS | diff "$scratch/head" -
    verdict "$(echo $1 | tr . _)_shows_the_example_of_its_header" $?
}

# head_example NAME OUTPUT [CODE]: the example at the head of cylint_NAME.h, and CODE.
head_example()
{
    sed -n '1,/\*\//s/^ \*     //p' "include/cylint_$1.h" > "$scratch/head"
    shows "cylint_$1.3"
    {
        printf '#include <cylint_%s.h>\n' "$1"
        cat << 'END'
#include <stdio.h>
int main(void)
{
    const double p0[3] = {0, 0, -20}, p1[3] = {0, 0, 20}, point[3] = {-50, 0, 0}, d[3] = {2, 0, 0};
    size_t n = 1;
    cylint_line line;
    cylint_hit hit = {0};
    cylint_shape shapes[1], shape;
    cylint_whole_line(&line, point, d);
    cylint_cylinder(&shape, p0, p1, 10, CYLINT_ENDS_CAPPED);
    shapes[0] = shape;
    (void)hit, (void)shapes, (void)n;
END
        cat "$scratch/head"
        printf '%s }\n' "$3"
    } > "$scratch/example.c"
    echo "$2" > "$scratch/example.said"
    example "the_example_of_cylint_$1_h" static $cc -std=c99
}

# examples_of PAGE PACKAGES NUMBER...: programs of a manual; after each comes its output.
# Those that need more packages than cylint link with shared libraries, too.
examples_of()
{
    page=$1 packages=$2
    shift 2
    for number; do
        display $page.3 $number > "$scratch/example.c"
        display $page.3 $((number + 1)) > "$scratch/example.said"
        threads=
        [ $page$number != cylint_scene3 ] || threads=-pthread
        for linking in static ${packages:+shared}; do
            example "${page}_example_${number}_${linking}_$(echo $packages | tr ' ' _)" \
                $linking $cc -std=c99 $threads
        done
    done
    packages=
}

test_manual_examples()
{
    sed -n 's/^ \*     //p' include/cylint.h | sed '/^}/q' > "$scratch/head"
    cp "$scratch/head" "$scratch/example.c"
    sed -n 's/^ \* prints "\(.*\)"\..*/\1/p' include/cylint.h > "$scratch/example.said"
    example the_header_begins_with_an_example static $cc -std=c99
    shows cylint.3
    head_example pieces '20 20.5' 'printf("%g %g\n", wall[0].t0, wall[0].t1);'
    head_example distance '40 from -10 0 0'
    head_example methods '2 hits'
    packages=cylint-scene
    head_example scene 'shape 0 at t = 20'
    for page in cylint cylint_distance cylint_pieces; do
        examples_of $page '' 1 3 5
    done
    examples_of cylint_methods '' 1
    examples_of cylint_scene cylint-scene 1 3 5 7 9 11
    [ "$pkg_config" ] && grep -q lembree3 "$lib/pkgconfig/cylint-embree.pc" 2>/dev/null || return
    for both in 'cylint-embree cylint-scene' 'cylint-scene cylint-embree'; do
        examples_of cylint_scene "$both" 1
    done
    examples_of cylint_embree cylint-embree 1 3 5
    display cylint_embree.3 1 SYNOPSIS > "$scratch/head"
    [ "$(display cylint_embree.3 1 | grep -cFf "$scratch/head")" -eq "$(grep -c ';' "$scratch/head")" ]
    verdict the_synopsis_of_cylint_embree_3_is_of_its_example $?
}

# structs FILE...: their structs, a line each, without comments
structs()
{
    cat "$@" | tr '\n' ' ' |
        awk '{ gsub(/[/][*]([^*]|[*][^/])*[*][/]/, ""); gsub(/ +/, " "); print }' |
        grep -o 'typedef struct cylint_[a-z_]* {[^}]*} [a-z_]*;' | sort -u
}

test_manual_structs()
{
    structs include/*.h > "$scratch/declared"
    structs man/*.3 > "$scratch/shown"
    [ "$(wc -l < "$scratch/shown")" -ge 16 ] || echo nothing >> "$scratch/shown"
    none "$(comm -13 "$scratch/declared" "$scratch/shown")" \
        the_manuals_show_the_structs_of_the_headers
}

# foreign_to LIBRARY NAMES: undefined symbols except NAMES and cylint_*.
foreign_to()
{
    nm -u "$lib/$1.a" | awk -v known="$(echo $2)" '
        BEGIN { n = split(known, name, " ")
                for (i = 1; i <= n; i++) fine[name[i]] = 1 }
        $1 == "U" && !($2 in fine) && $2 !~ /^cylint_/ { print $2 }' | sort -u
}

# declared HEADER...: the functions that the headers declare.
declared()
{
    for header; do
        grep -v '^ *#' "include/$header" | tr -s '\n ' '  ' |
            grep -o 'CYLINT_API [^(;]*(' | sed 's/.*[ *]\(cylint_[a-z0-9_]*\)($/\1/'
    done
}

# missing_from LIBRARY: functions on standard input that it does not export.
missing_from()
{
    nm -D --defined-only "$1" | awk '{ print $3 }' | sort > "$scratch/exported"
    sort | comm -23 - "$scratch/exported"
}

test_symbols()
{
    command -v nm > /dev/null || { echo 'note: no nm, symbols are not looked at'; return; }
    for library in libcylint libcylint-scene; do
        none "$(nm -D --defined-only "$lib/$library.so" |
            awk '$3 !~ /^cylint_/ { print $3 }')" \
            "shared_${library}_exports_only_its_own_names"
        none "$(nm -g --defined-only "$lib/$library.a" |
            awk 'NF == 3 && $3 !~ /^cylint_/ { print $3 }')" \
            "static_${library}_defines_only_its_own_names"
    done
    none "$(declared cylint.h cylint_distance.h cylint_pieces.h cylint_methods.h |
        missing_from "$lib/libcylint.so")" libcylint_exports_every_function_of_its_headers
    none "$(declared cylint_scene.h | missing_from "$lib/libcylint-scene.so")" \
        libcylint_scene_exports_every_function_of_its_header
    none "$(nm -D --defined-only "$lib/libcylint-scene.so" |
        awk '$3 !~ /^(cylint_scene_|cylint_piece_rows_)/ { print $3 }')" \
        a_scenes_library_exports_only_scenes
    # So threads share only what callers pass.  `tiny` and `least` are volatile
    # constants; PARANOID=1 counts stages.
    [ -n "${PARANOID:-}" ] || ! objdump -t "$lib"/libcylint*.a |
        awk '/ O (\.t?(data|bss)|\*COM\*)[ \t]/ && $NF !~ /(^|\.)(tiny|least)(\.[0-9]+)?$/ { print $NF }' |
        grep -v '^cylint_build_used$'
    verdict the_only_state_is_the_choice_of_kernels $?
    # Functions of math.h, and those that compilers call for loops and copies.
    math='acos asin atan atan2 ceil copysign cos cospi fabs floor fma fmax fmin fmod frexp
        hypot ilogb ldexp log log2 logb lrint modf nearbyint nextafter pow rint round scalbln
        scalbn sin sincos sinpi sqrt tan trunc'
    memory='memcpy memmove memset memcmp strlen strcmp __stack_chk_fail'
    # __cpu_...: the compiler's record of the processor
    others='_GLOBAL_OFFSET_TABLE_ __assert_fail __cpu_model __cpu_indicator_init'
    [ -z "${PARANOID:-}" ] || others="$others abort" # what that is for
    none "$(foreign_to libcylint "$math $memory $others")" \
        the_library_uses_only_mathematics_and_memory
    heap='malloc calloc realloc free madvise'
    threads="sysconf sched_getaffinity __sched_cpucount $(printf 'pthread_%s ' create join mutex_lock mutex_unlock mutex_destroy self \
        attr_init attr_getstacksize attr_setstacksize attr_destroy)"
    # of a saved scene
    files='fileno fstat lstat stat mmap munmap getpid fopen fread fwrite fclose ferror fseek ftell rewind
        rename remove realpath snprintf strrchr __errno_location
        open close fdopen fchmod fchown'
    none "$(foreign_to libcylint-scene "$math $memory $others $heap $threads $files sqrtf")" \
        scenes_use_memory_threads_and_files_and_nothing_else
}

# With -O0: what it tests is that the files find each other.
test_without_makefile()
{
    here=$(pwd)
    mkdir -p "$scratch/bare" &&
        for f in $(find src -name '*.c' ! -path 'src/scene/*' \
            ! -path 'src/embree/*' ! -path 'src/bvh/*'); do
            object=$scratch/bare/$(echo "${f#src/}" | tr / -)
            (cd "$scratch" && quiet $cc -O0 -ffp-contract=off \
                -I"$here/include" -c "$here/$f" -o "${object%.c}.o") || exit 1
        done &&
        quiet $cc -I include -o "$scratch/bare/example" \
            "$scratch/example.c" "$scratch"/bare/*.o -lm &&
        "$scratch/bare/example" | diff "$scratch/example.said" -
}

# The README's console blocks are transcripts of the installed command.
test_readme_commands()
{
    mkdir "$scratch/work"
    ln -s "$top/tools" "$scratch/work/tools"
    awk '/^```/ { inside = $0 == "```console"; print ""; next } inside' README.md > "$scratch/shown"
    PATH=$root/usr/bin:$PATH run_transcripts README.md < "$scratch/shown"
    [ "$(grep -c '^\$ ' "$scratch/shown")" -ge 6 ]
    verdict the_readme_shows_commands $?
}

# In $prefix some folders are there before make install, which is run twice.
test_uninstall()
{
    make_in_root uninstall && [ "$(find "$root")" = "$root" ] || { find "$root"; false; }
    verdict uninstall_leaves_nothing_behind $?
    prefix=$scratch/prefix
    mkdir -p "$prefix/share/man/man3" "$prefix/bin" "$prefix/lib/other"
    find "$prefix" | sort > "$scratch/before"
    make_here PREFIX="$prefix" install && make_here PREFIX="$prefix" install &&
        touch "$prefix/include/other.h" "$prefix/share/man/man3/cylinter.3" && make_here PREFIX="$prefix" uninstall
    { cat "$scratch/before"; echo "$prefix/include"; echo "$prefix/include/other.h"
      echo "$prefix/share/man/man3/cylinter.3"; } | sort > "$scratch/after"
    find "$prefix" | sort | diff "$scratch/after" -
    verdict uninstall_removes_the_empty_folders_that_install_made $?
}

test_install
test_strip
test_pkg_config
test_example
test_cxx
test_readme_install
test_hints
test_symbols
(test_without_makefile)
verdict the_library_compiles_without_the_makefile $?
test_readme_commands
test_manual_examples
test_manual_structs
test_uninstall
check_end
