#!/bin/sh
# Records of bare numbers, -k, give the same bytes as records with words, for all
# kinds.
. "$(dirname "$0")/../support/verdict.sh"
cd "$scratch" || exit 1
PATH=$build:$PATH

# Records of all families, with tails, comments and directions without length.
"$build/tests/package/records" 5 80000 | awk '
    NR % 97 == 0 { print "# " NR }
    NR % 50 == 0 { $5 = $6 = $7 = 0 }
    { print $0 (NR % 2 ? "" : " r" NR) }' >all

same() { # NAME KINDS, then options
    name=$1 kinds=$2
    shift 2
    cylint "$@" worded >want 2>messages
    echo "$? $(wc -l <messages)" >>want
    cylint -k "$kinds" "$@" bare >out 2>messages
    echo "$? $(wc -l <messages)" >>out
    cmp want out && [ "$(wc -l <out)" -gt 100 ]
    verdict "$kinds: $name" $?
}

for line in line ray segment span; do
    for shape in cylinder cone ecylinder econe acone sphere capsule rcone \
        halfspace; do
        grep -e '^#' -e "^$line .* $shape " all >worded
        sed "s/^$line//; s/ $shape / /" worded >bare
        same 'both hits' $line,$shape -f id,relation,n,t0,t1,part0,part1,chord -C
        same 'the nearest hit' $line,$shape -f t0,side0,nx0 --hits-only
    done
done

check_end
