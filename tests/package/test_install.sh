#!/bin/sh
# The transcripts of install.txt: what make install puts into a folder works, the examples
# of the README, the headers and the manuals compile and link with it, and uninstall
# removes it.  Then the README's console blocks run, which are transcripts.
. "$(dirname "$0")/../support/verdict.sh"
. tests/support/transcripts.sh
. "$(dirname "$0")/../support/installs.sh"
command -v pkg-config > /dev/null || echo 'note: no pkg-config, the .pc files are not read'
export make cc cxx version
run_transcripts install.txt < tests/package/install.txt

rm -r "$scratch/work"
mkdir "$scratch/work"
ln -s "$top/tools" "$scratch/work/tools"
awk '/^```/ { inside = $0 == "```console"; print ""; next } inside' README.md > "$scratch/shown"
run_transcripts README.md < "$scratch/shown"
[ "$(grep -c '^\$ ' "$scratch/shown")" -ge 6 ]
verdict the_readme_shows_commands $?
check_end
