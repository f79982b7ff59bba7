# error_bounds.h: K operations, each a factor 1 + d, and what the size computed in
# doubles may lack: the roundings on its own path, of the bound's product and
# sum, and of a pair's 8 factors what their high parts leave out.
# modes: ne
# bound: CYLINT_FILTER_BOUND
# each: CYLINT_ROUNDING
{ RANGES(CYLINT_DEPTH)
  -> |(FACTORS(CYLINT_DEPTH) - 1) / (SHRINK(CYLINT_DEPTH) * SHRINK(10))|
     <= BOUND }
