/*
 * work.cc - a call's work in blocks, by several threads, without Python's lock
 */
#include "work.h"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <exception>
#include <mutex>
#include <system_error>
#include <thread>
#include <vector>

namespace nb = nanobind;

namespace
{

using Clock = std::chrono::steady_clock;

/* How often the calling thread takes the lock. */
constexpr auto pause = std::chrono::milliseconds(50);

/* Starting a thread takes about the time of this many small blocks. */
constexpr size_t blocks_a_thread = 4;

class Work
{
  public:
    Work(size_t n, size_t elements, nb::handle callback,
         const std::function<bool(int, size_t)> &function)
        : blocks(n), total(elements), progress(callback), task(function)
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
        if (!stopped && !progress.is_none())
            progress(total, total);
    }

  private:
    void loop(int worker)
    {
        auto due = Clock::now() + pause;
        try {
            for (size_t i; !stopped && (i = next++) < blocks; done++) {
                if (!task(worker, i))
                    stopped = true;
                if (worker == 0 && Clock::now() >= due) {
                    listen();
                    due = Clock::now() + pause;
                }
            }
        } catch (...) {
            const std::lock_guard<std::mutex> hold(lock);
            if (!failure)
                failure = std::current_exception();
            stopped = true;
        }
    }

    void listen()
    {
        nb::gil_scoped_acquire acquired;
        if (PyErr_CheckSignals() != 0)
            throw nb::python_error();
        if (!progress.is_none()) {
            const double part =
                static_cast<double>(done) / static_cast<double>(blocks);
            progress(static_cast<size_t>(part * static_cast<double>(total)),
                     total);
        }
    }

    const size_t blocks, total;
    const nb::handle progress;
    const std::function<bool(int, size_t)> &task;
    std::atomic<size_t> next{0}, done{0};
    std::atomic<bool> stopped{false};
    std::mutex lock;
    std::exception_ptr failure;
};

} // namespace

void work(size_t blocks, size_t total, int threads, nb::handle progress,
          const std::function<bool(int, size_t)> &task)
{
    const size_t most = blocks / blocks_a_thread + 1;
    Work(blocks, total, progress, task)
        .run(static_cast<int>(
            std::min(most, static_cast<size_t>(std::max(threads, 1)))));
}
