# The running error of pairs: one unit, over the roundings that the sum of them
# meets in doubles, 5 an operation and 5 of its use.
# modes: ne
# bound: CYLINT_PAIR_UNIT
# each: CYLINT_PAIR_ROUNDING
{ RANGES(1) -> |d1 / (SHRINK(CYLINT_DEPTH) * SHRINK(CYLINT_DEPTH)
                      * SHRINK(CYLINT_DEPTH) * SHRINK(CYLINT_DEPTH)
                      * SHRINK(CYLINT_DEPTH) * SHRINK(5))| <= BOUND }
