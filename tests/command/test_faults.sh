#!/bin/sh
# When system calls are short, interrupted or late, no answer is lost, reordered or
# changed; when they fail, the command prints a message and stops at the end of a
# line.  faults.c makes the calls fail.  hostile.txt has hostile input and the failures
# that a shell can make.
. "$(dirname "$0")/../support/verdict.sh"
[ -x "$build/tests/command/faulty" ] || skip_all 'no linker that wraps calls'
cd "$scratch" || exit 1
cylint=$build/cylint faulty=$build/tests/command/faulty
: "${WORKERS:=1 2}"

check_wrong() { # NAME; fails if $wrong is not empty
    [ -z "$wrong" ]
    verdict "$1:$wrong" $?
    wrong=
}

# ---------------------------------------------------------------- inputs --

# Records of all kinds with their number as a tail; some are bad, and some lines
# are comments or blank.
awk 'function num(most) { return sprintf("%.17g", (2 * rand() - 1) * most) }
function three(most) { return num(most) " " num(most) " " num(most) }
BEGIN {
    srand(3)
    split("line ray segment span", lines)
    split("cylinder cone ecylinder econe acone", shapes)
    split("7 8 12 13 7", numbers)
    split("capped open cap0 cap1 infinite nappe", ends)
    for (i = 1; i <= 9000; i++) {
        kind = 1 + int(5 * rand())
        text = lines[l = 1 + int(4 * rand())] " " three(3) " " three(1)
        if (l == 4) text = text " -2 " 6 * rand()
        text = text "\t" shapes[kind]
        for (j = 1; j <= numbers[kind]; j++)
            text = text ", " (j == 4 && kind == 2 || j == numbers[kind] && kind != 3 \
                ? 2 * rand() + 0.1 : num(2))
        if (i % 3 == 0) text = text " ends=" ends[1 + int(6 * rand())]
        if (i % 701 == 0) text = "nonsense"
        if (i % 211 == 0) print "# comment\n"
        print text " r" i (i % 5 == 0 ? "\r" : "")
    }
}' >pairs
awk 'BEGIN { for (i = 0; i < 400; i++) print "cylinder", i % 20, int(i / 20),
    "0", i % 20 + 0.3, int(i / 20), 1, 0.2 + i / 2000, "s" i % 150 }' >shapes
awk 'BEGIN { srand(5); for (i = 1; i <= 4000; i++) print (i % 999 ? "ray" : "rye"),
    20 * rand(), 20 * rand(), "5  " rand() - 0.5, rand() - 0.5,
    i % 3 ? "-1 q" i : "-1 not=s" i % 150 " q" i }' >rays
# Some of their answers take memory for every line.
sed 's/not=[^ ]* //' rays | sed -n '900,1100p' >walk
sed -n '95,105p' walk >steps # sums take memory twice for each
awk '{ n = int(NR / 3); word = NR % 3 ? (NR % 3 == 1 ? "in=w" : "out=w") n : ""
    $8 += NR % 3 / 9; $9 = word " " $9; print }' shapes >walls
for i in 1 2 3 4 5 6; do echo s$i $((i % 4 - 2)); done >ranks
awk 'BEGIN { for (i = 0; i < 2500; i++) print i, 0, i % 20, int(i / 20) % 20,
    i % 7 / 9, i / 9000, i ? int((i - 1) * 0.99) : -1 }' >neuron.swc
# The hits of the pairs are 13 doubles each; they serve as rays and cylinders.
"$cylint" --binary-out -f x0,y0,z0,nx0,ny0,nz0,x1,y1,z1,nx1,ny1,nz1,chord \
    pairs >doubles 2>/dev/null

"$cylint" --save shapes.saved -s shapes 2>/dev/null

jobs='pairs scene saved binary'
answer() { # PROGRAM JOB [OPTION]...: reads standard input
    program=$1 job=$2
    shift 2
    case $job in
    pairs) "$program" -f relation,n,t0,t1,part0,part1,id "$@" ;;
    scene) "$program" -s shapes -q all --not label -f id,shape,label,t0,t1 "$@" ;;
    saved) "$program" -s shapes.saved -q all --not label -f id,shape,label,t0,t1 "$@" ;;
    neuron) "$program" -s neuron.swc "$@" ;;
    pieces) "$program" -s walls -q pieces --pieces cells --rank ranks "$@" ;;
    sums) "$program" -s walls -q pieces --sum label "$@" ;;
    first) "$program" -s walls -q first -f shape,label,t,nx "$@" ;;
    binary) "$program" -b -k ray,cylinder -f n,t0,t1,id "$@" ;;
    esac
}
input_of() {
    case $1 in
    pairs) echo pairs ;;
    scene | saved | neuron) echo rays ;;
    pieces | first) echo walk ;;
    sums) echo steps ;;
    binary) echo doubles ;;
    esac
}

# One worker without failures gives the expected answers.  The tails show that
# they are complete and in order.
for job in $jobs neuron pieces sums first; do
    answer "$cylint" $job -j 1 <"$(input_of $job)" >$job.out 2>$job.err
    [ $? -eq 1 ] && [ -s $job.out ] && [ -s $job.err ] || wrong="$wrong $job"
done
cmp -s scene.out saved.out && cmp -s scene.err saved.err || wrong="$wrong saved"
cut -f 8 pairs.out | grep -v '^$' >ids
awk 'BEGIN { for (i = 1; i <= 9000; i++) if (i % 701) print "r" i }' | cmp -s - ids ||
    wrong="$wrong ids"
[ "$(wc -l <pairs.out)" -eq 9000 ] || wrong="$wrong count"
check_wrong 'the expected answers have all records in order'

# ------------------------------------- short, interrupted and late calls --

same() { # JOB STATUS WHAT: out and err are as expected
    [ "$2" -eq 1 ] || wrong="$wrong $3: status $2;"
    cmp -s $1.out out || wrong="$wrong $3: other answers;"
    cmp -s $1.err err || wrong="$wrong $3: other messages;"
}

badly() { # NAME FAULTS: from a file and through a pipe
    for job in $jobs; do
        for j in $WORKERS; do
            CYLINT_FAULTS=$2 answer "$faulty" $job -j $j <"$(input_of $job)" >out 2>err
            same $job $? "$job -j $j from a file"
            { cat "$(input_of $job)" | {
                CYLINT_FAULTS=$2 answer "$faulty" $job -j $j 2>err
                echo $? >code
            }; } | cat >out
            same $job "$(cat code)" "$job -j $j from a pipe"
        done
    done
    check_wrong "$1"
}

badly 'wrapped calls that do no harm' 'leaks=1'
badly 'short reads and writes' 'short=1 leaks=1'
badly 'interrupted calls' 'eintr=1'
badly 'calls that would block' 'again=1'
badly 'polls that say wait' 'wait=1'
badly 'a storm of signals' 'storm=50'
badly 'standard input and output that do not block' 'nonblock=1'
for seed in 2 3; do
    badly "all at once ($seed)" \
        "short=$seed eintr=$seed again=$seed wait=$seed storm=300 nonblock=1"
done

# A writer of single bytes with pauses.  The command must wait for them; with too
# many calls it polls instead.
head -n 3 pairs | cut -c 1-60 >few
answer "$cylint" pairs <few >few.out 2>few.err
for j in $WORKERS; do
    { i=1
    while [ $i -le "$(wc -c <few)" ]; do
        tail -c +$i few | head -c 1
        [ $((i % 20)) -ne 0 ] || sleep 0.02
        i=$((i + 1))
    done; } | {
        CYLINT_FAULTS='nonblock=1 calls=1000' answer "$faulty" pairs -j $j >out 2>err
        echo $? >code
    }
    same few "$(cat code)" "-j $j"
done
check_wrong 'single bytes, from a pipe that does not block'

# A reader that sleeps while its pipe becomes full.
for j in $WORKERS; do
    { CYLINT_FAULTS='nonblock=1 calls=2000' answer "$faulty" scene -j $j <rays 2>err
    echo $? >code; } | { sleep 0.3; cat >out; }
    same scene "$(cat code)" "-j $j"
done
check_wrong 'a slow reader of a pipe that does not block'

# ------------------------------------------------------------- failures --

stopped() { # STATUS EXPECTED MESSAGE WHAT
    [ "$1" -eq "$2" ] || wrong="$wrong $4: status $1;"
    [ "$(grep -cFx "cylint: $3" err)" -eq 1 ] || wrong="$wrong $4: $(head -n 1 err);"
}

first_lines() { # JOB LINES WHAT: out is the first lines of what is right
    head -n "$2" $1.out | cmp -s - out || wrong="$wrong $3: other answers;"
}

# Complete records are answered, whatever part of the next one was read.
whole=$(head -n 5000 pairs | wc -c)
for bytes in 0 1 $((whole - 1)) $whole $((whole + 1)) 262144; do
    lines=$(head -n "$(head -c $bytes pairs | wc -l)" pairs | grep -c '^[a-z]')
    for j in $WORKERS; do
        CYLINT_FAULTS="read=$bytes short=5" answer "$faulty" pairs -j $j <pairs >out 2>err
        stopped $? 3 'stdin: Input/output error' "$bytes -j $j"
        first_lines pairs "$lines" "$bytes -j $j"
    done
done
check_wrong 'a read that fails in mid-file'

for j in $WORKERS; do
    CYLINT_FAULTS="read=$(($(wc -c <shapes) - 5))" answer "$faulty" scene -j $j <rays >out 2>err
    stopped $? 3 'shapes: Input/output error' "-j $j"
    first_lines scene 0 "-j $j"
    CYLINT_FAULTS="read=$(($(wc -c <neuron.swc) - 5))" answer "$faulty" neuron -j $j <rays >out 2>err
    stopped $? 3 'neuron.swc: Input/output error' "-j $j"
    first_lines neuron 0 "-j $j"
done
check_wrong 'a read that fails in the scene'

for j in $WORKERS; do
    for bytes in 0 1 100000; do
        CYLINT_FAULTS="write=$bytes short=6 eintr=6" answer "$faulty" pairs -j $j \
            <pairs >out 2>err
        stopped $? 3 'standard output: No space left on device' "$bytes -j $j"
        first_lines pairs "$(head -c $bytes pairs.out | wc -l)" "$bytes -j $j"
        CYLINT_FAULTS="write=$bytes" answer "$faulty" binary -j $j <doubles >out 2>err
        stopped $? 3 'standard output: No space left on device' "$bytes -j $j"
        head -c $((bytes / 32 * 32)) binary.out | cmp -s - out ||
            wrong="$wrong $bytes -j $j: other rows;"
        CYLINT_FAULTS="write=$bytes" answer "$faulty" pairs -j $j <pairs 2>err | cat >out
        head -c $bytes pairs.out | cmp -s - out || wrong="$wrong $bytes -j $j: other bytes;"
    done
    CYLINT_FAULTS='close=1' answer "$faulty" pairs -j $j <few >out 2>err
    stopped $? 3 'standard output: Input/output error' "close -j $j"
done
check_wrong 'a write or a close that fails'

# -o FILE is the old file or the whole new one, and no other file is left.
unchanged() { # WHAT
    [ "$(cat kept/old)" = old ] || wrong="$wrong $1: the old file changed;"
    [ "$(ls kept)" = old ] || wrong="$wrong $1: $(echo $(ls kept));"
}

fails() { # FAULTS STATUS MESSAGE COMMAND...: it stops so, and no file changes
    faults=$1 expected=$2 message=$3
    shift 3
    CYLINT_FAULTS="$faults leaks=1" "$@" 2>err
    stopped $? $expected "$message" "$faults: $*"
    unchanged "$faults: $*"
}

made_in_the_end() { # COMMAND...: it stops if allocation 1, 2, ... $n - 1 fails
    n=1
    while [ $n -lt 300 ] && ! CYLINT_FAULTS="alloc=$n leaks=1" "$@" >out 2>err; do
        stopped 4 4 'out of memory' "alloc=$n $*"
        unchanged "alloc=$n $*"
        n=$((n + 1))
    done
}

mkdir kept
echo old >kept/old
for j in $WORKERS; do
    for name in old new; do
        for fault in write=0 write=100000 fsync=1 rename=1; do
            fails $fault 3 "kept/$name: No space left on device" \
                answer "$faulty" pairs -j $j -o kept/$name <pairs
        done
        for fault in write=0 write=10000 fsync=1 rename=1; do
            fails $fault 3 "kept/$name: No space left on device" \
                "$faulty" -j $j --save kept/$name -s shapes
        done
        fails read=100000 3 'stdin: Input/output error' \
            answer "$faulty" pairs -j $j -o kept/$name <pairs
        fails alloc=1 4 'out of memory' answer "$faulty" pairs -j $j -o kept/$name <pairs
    done
    # The first close is that of the old file.
    fails close=2 3 'kept/old: Input/output error' answer "$faulty" pairs -j $j -o kept/old <few
    fails write=4000 3 'kept/old: No space left on device' \
        answer "$faulty" binary -j $j --npy -o kept/old <doubles
    made_in_the_end "$faulty" --text -s walls
    [ $n -gt 5 ] && "$cylint" --text -s walls | cmp -s - out || wrong="$wrong alloc=$n --text: other text;"
    made_in_the_end "$faulty" -j $j --save kept/new -s shapes
    [ $n -gt 5 ] && cmp -s kept/new shapes.saved || wrong="$wrong alloc=$n --save -j $j: other bytes;"
    CYLINT_FAULTS='short=4 eintr=4 again=4' "$faulty" -j $j --save kept/new -s shapes 2>err
    cmp -s kept/new shapes.saved || wrong="$wrong interrupted --save -j $j;"
    rm kept/new
    CYLINT_FAULTS='short=4 eintr=4 again=4' answer "$faulty" pairs -j $j -o kept/new \
        <pairs 2>err
    code=$?
    mv kept/new out
    same pairs $code "interrupted -j $j"
    unchanged "interrupted -j $j"
done
check_wrong 'a file that cannot be written to its end stays as it was'

# A signal that ends the work removes what was written.  nohup ignores SIGHUP.
mkfifo waits
heeds='env --default-signal=HUP'
$heeds true 2>/dev/null || heeds=
for j in $WORKERS; do
    for signal in HUP TERM USR1 USR2 XCPU; do
        $heeds "$cylint" -j $j -o kept/old <waits 2>err &
        pid=$!
        { cat pairs
          for i in $(seq 100); do
              [ "$(ls kept | wc -l)" -eq 2 ] && break
              sleep 0.1
          done
          kill -$signal $pid
          wait $pid; } >waits 2>/dev/null
        [ $? -gt 128 ] || wrong="$wrong $signal -j $j;"
        unchanged "$signal -j $j"
    done
done
check_wrong 'a signal leaves the old file and no other'

# For every n the n-th allocation fails, alone or with all later ones.
mkdir died
all_stopped() { # JOB WHAT: died/*.out are first lines, with one message in died/*.err
    wc -l died/*.out | awk -v answers=$1.out '
        BEGIN { while ((getline line < answers) > 0) text[++n] = line }
        $2 != "total" { for (i = 1; i <= $1; i++) print text[i] }' >expected
    cat died/*.out | cmp -s - expected || wrong="$wrong $2: other answers;"
    other=$(grep -cFx 'cylint: out of memory' died/*.err | grep -v ':1$')
    [ -z "$other" ] || wrong="$wrong $2: messages of $other;"
}

for job in $jobs neuron pieces sums first; do
    for j in $WORKERS; do
        CYLINT_FAULTS='count=1' answer "$faulty" $job -j $j <"$(input_of $job)" 2>&1 >out |
            sed -n 's/^faults: \(.*\) allocations/\1/p' >count
        n=$(cat count) died=0
        [ "$n" -lt 1000 ] || n=1000
        while [ "$n" -gt 0 ]; do
            for fault in alloc allocs; do
                CYLINT_FAULTS="$fault=$n leaks=1" answer "$faulty" $job -j $j \
                    <"$(input_of $job)" >died/$fault$n.out 2>died/$fault$n.err
                status=$?
                case $status in
                1) mv died/$fault$n.out out
                   mv died/$fault$n.err err
                   same $job 1 "$job -j $j $fault=$n" ;;
                4) died=$((died + 1)) ;;
                *) wrong="$wrong $job -j $j $fault=$n: status $status;" ;;
                esac
            done
            n=$((n - 1))
        done
        [ $died -ge 8 ] || wrong="$wrong $job -j $j: only $died of $(cat count) matter?"
        all_stopped $job "$job -j $j"
        rm died/*
    done
done
check_wrong 'out of memory at the n-th allocation, for every n'

n=0
while [ $n -lt 9 ]; do
    n=$((n + 1))
    CYLINT_FAULTS="thread=$n leaks=1" answer "$faulty" pairs -j 4 <pairs >out 2>err
    same pairs $? "thread=$n"
done
CYLINT_FAULTS='pipe=1 leaks=1' answer "$faulty" pairs -j 4 <pairs >out 2>err
same pairs $? 'no pipe'
check_wrong 'threads that cannot be made'

if cpu=$(taskset -cp $$ 2>/dev/null); then
    cpu=${cpu##*: }
    awk 'BEGIN { for (i = 0; i < 20000; i++) print "sphere", i, "0 0 1" }' >row
    CYLINT_FAULTS=threads=0 taskset -c "${cpu%%[-,]*}" "$faulty" --save built -s row \
        2>err || wrong=" $(cat err)"
    check_wrong 'a scene is built by as many threads as there are processors to use'
fi

# All functions that the command calls to read, write, rename or allocate are
# wrapped, so that a new one is not forgotten.
nm -u "$build"/tools/cylint/*.o | awk '{ print $NF }' | sort -u | grep -Ex \
    '(f|fd|fre|p|open_mem)open.*|creat|f?read|f?write|[pf]?(read|write)v|pread|pwrite|send|recv|getc.*|fgets|getdelim|getline|mmap|.*alloc|strn?dup|v?asprintf|p?select|ppoll|dup[23]?|pipe|fork|aligned_alloc|fd?a?t?a?sync|rename(at)?|link(at)?|mks?temps?' |
    grep -Evx 'read|write|fwrite|[mc]alloc|realloc|pipe|fsync|rename' >unwrapped
[ ! -s unwrapped ] || wrong=" $(cat unwrapped)"
check_wrong 'there are no other calls that can fail'

check_end
