/*
 * work.cc - a call's work in blocks, by several threads, without Python's lock
 */
#include "work.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace nb = nanobind;

namespace
{

/* How often the calling thread takes the lock. */
constexpr auto interval = std::chrono::milliseconds(50);

/* Starting a thread takes about the time of this many small blocks. */
constexpr size_t blocks_a_thread = 4;

class Work
{
  public:
    Work(size_t n, size_t elements, nb::handle progress,
         const std::function<bool(int, size_t)> &function)
        : blocks(n), listener(progress, elements), task(function)
    {
    }

    void run(int threads)
    {
        {
            nb::gil_scoped_release released;
            std::vector<std::thread> started;
            try {
                for (int i = 1; i < threads; i++)
                    started.emplace_back([this, i] { loop(i); });
            } catch (const std::system_error &) {
                /* fewer threads do the same work */
            }
            loop(0);
            for (std::thread &thread : started)
                thread.join();
        }
        if (failure)
            std::rethrow_exception(failure);
        if (!stopped)
            listener.end();
    }

  private:
    void loop(int worker)
    {
        try {
            for (size_t i; !stopped && (i = next++) < blocks; done++) {
                if (!task(worker, i))
                    stopped = true;
                if (worker == 0)
                    listener.listen(static_cast<double>(done) /
                                    static_cast<double>(blocks));
            }
        } catch (...) {
            const std::lock_guard<std::mutex> hold(lock);
            if (!failure)
                failure = std::current_exception();
            stopped = true;
        }
    }

    const size_t blocks;
    Listener listener;
    const std::function<bool(int, size_t)> &task;
    std::atomic<size_t> next{0}, done{0};
    std::atomic<bool> stopped{false};
    std::mutex lock;
    std::exception_ptr failure;
};

} // namespace

Listener::Listener(nb::handle callback, size_t elements)
    : progress(callback), total(elements), due(Clock::now() + interval)
{
}

void Listener::listen(double part)
{
    if (Clock::now() < due)
        return;
    {
        nb::gil_scoped_acquire acquired;
        if (PyErr_CheckSignals() != 0)
            throw nb::python_error();
        if (!progress.is_none())
            progress(static_cast<size_t>(part * static_cast<double>(total)),
                     total);
    }
    due = Clock::now() + interval;
}

void Listener::end() const
{
    if (!progress.is_none())
        progress(total, total);
}

void work(size_t blocks, size_t total, int threads, nb::handle progress,
          const std::function<bool(int, size_t)> &task)
{
    const size_t most = blocks / blocks_a_thread + 1;
    Work(blocks, total, progress, task)
        .run(static_cast<int>(
            std::min(most, static_cast<size_t>(std::max(threads, 1)))));
}
