#!/bin/sh
# The transcripts of packages.txt, about what is packed for those who link.  `make dist`
# writes the same bytes again, and its files build; CMake finds what make install
# installs, and builds the sources within another project.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
. "$(dirname "$0")/../support/installs.sh"

run() # PART...
{
    for part; do
        awk -v title=" $part " '/^# --/ { inside = index($0, title) } inside' \
            tests/package/packages.txt > "$scratch/part"
        run_transcripts packages.txt < "$scratch/part"
    done
}

export make cc cxx version
PATH=$PATH:$build/python/bin
run helpers
if git rev-parse HEAD > /dev/null 2>&1; then
    run 'make dist'
else
    echo 'note: no repository, make dist is not tested'
fi
if command -v cmake > /dev/null; then
    run CMake FetchContent
else
    echo 'note: no CMake (make deps)'
fi
[ ! -e "$scratch/work/first" ] || run command
check_end
