#!/bin/sh
# Floor command: records of bare numbers, -k, give the same bytes as records with
# words, for all kinds.
. "$(dirname "$0")/../support/verdict.sh"
cd "$scratch" || exit 1
PATH=$build:$PATH

# records KINDS: prints records with ends, tails, comments and invalid shapes.
records() {
    awk -v kinds="$1" '
    function any() { return int(2001 * rand() - 1000) / 250 }
    function numbers(count,    text) {
        while (count-- > 0) text = text " " any()
        return text
    }
    BEGIN {
        split(kinds, kind, ",")
        count["line"] = count["ray"] = 6; count["span"] = 8
        count["cylinder"] = 6; count["cone"] = 3; count["acone"] = 6
        count["ecylinder"] = 12; count["econe"] = 12
        split("capped open cap0 cap1 infinite nappe", ends)
        for (i = 1; i <= 1500; i++) {
            if (i % 97 == 0) print "# " i
            line = kind[1] == "span" ? numbers(6) " -" 4 * rand() " " 4 * rand() \
                                     : numbers(count[kind[1]])
            if (i % 5 == 0) line = " 0 0 0 0 0 " i % 2 (kind[1] == "span" ? " 0 9" : "")
            shape = numbers(count[kind[2]])
            if (kind[2] == "cone") shape = shape " " 2 * rand() numbers(3)
            if (kind[2] == "cylinder" || kind[2] == "econe" || kind[2] == "cone")
                shape = shape " " 2 * rand()
            if (kind[2] == "acone") shape = shape " " 89 * rand()
            print kind[1] line " " kind[2] shape (i % 3 ? "" : " ends=" ends[1 + i % 6]) \
                (i % 2 ? "" : " r" i)
        }
    }'
}

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

for line in line ray span; do
    for shape in cylinder cone ecylinder econe acone; do
        records $line,$shape >worded
        sed "s/^$line//; s/ $shape / /" worded >bare
        same 'both hits' $line,$shape -f id,relation,n,t0,t1,part0,part1,chord -C
        same 'the nearest hit' $line,$shape -f t0,side0,nx0 --hits-only
    done
done

check_end
