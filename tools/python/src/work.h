/*
 * work.h - a call's work in blocks, by several threads, without Python's lock
 */
#ifndef CYLINT_PYTHON_WORK_H
#define CYLINT_PYTHON_WORK_H

#include <nanobind/nanobind.h>

#include <chrono>
#include <cstddef>
#include <functional>
#include <optional>

/* progress(done, total), or nothing */
using Callback = std::optional<nanobind::object>;

/*
 * Lets Python handle signals and calls progress(done, total), unless progress is
 * None, several times a second during work without Python's lock.
 */
class Listener
{
  public:
    Listener(const Callback &callback, size_t elements);
    /* `part` of the work is done, 0 to 1.  Throws exceptions of Python. */
    void listen(double part);
    /* All is done.  The caller has Python's lock. */
    void end() const;

  private:
    using Clock = std::chrono::steady_clock;
    const Callback progress;
    const size_t total;
    Clock::time_point due;
};

/*
 * Calls task(worker, block) for all blocks, in their order, from at most
 * `threads` threads; worker is below `threads`.  Python's lock is released.  The
 * calling thread works too, and it listens: done counts elements, of which a
 * block has total / blocks on average.  The last call of progress has done =
 * total.  An exception of Python or of a task ends the work and is passed on.  A
 * task that returns false ends it, too.
 */
void work(size_t blocks, size_t total, int threads, const Callback &progress,
          const std::function<bool(int worker, size_t block)> &task);

#endif
