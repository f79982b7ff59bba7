#!/bin/sh
# What make install puts into a scratch folder works: the examples of the README, the
# headers and the manuals compile and link with it, the README's commands run, and what
# install.txt shows.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
. "$(dirname "$0")/../support/installs.sh"
root=$scratch/root
lib=$root/usr/lib
pkg_config=$(command -v pkg-config) || echo 'note: no pkg-config, the .pc files are not read'

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

# The README's console blocks are transcripts of the installed command.
test_readme_commands()
{
    rm -r "$scratch/work"
    mkdir "$scratch/work"
    ln -s "$top/tools" "$scratch/work/tools"
    awk '/^```/ { inside = $0 == "```console"; print ""; next } inside' README.md > "$scratch/shown"
    PATH=$root/usr/bin:$PATH run_transcripts README.md < "$scratch/shown"
    [ "$(grep -c '^\$ ' "$scratch/shown")" -ge 6 ]
    verdict the_readme_shows_commands $?
}

make_here DESTDIR="$root" PREFIX=/usr install
verdict install_succeeds $?
export make cc cxx version
run_transcripts install.txt < tests/package/install.txt
test_example
test_readme_commands
test_manual_examples
check_end
