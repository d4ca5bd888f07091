#pragma once

#include <atomic>
#include <csignal>
#include <ctime>
#include <unistd.h>

namespace packtrace {

/// Makes a signal handler that ends the program wait for critical sections of threads, such as
/// between creating a file and noting it as one to remove.
class SignalGate {
public:
    /// The handler waits while a Passage exists. This thread blocks signals meanwhile, so that the
    /// handler never waits for itself.
    class Passage {
    public:
        explicit Passage(SignalGate& gate) : gate_(gate)
        {
            sigset_t all;
            sigfillset(&all);
            pthread_sigmask(SIG_SETMASK, &all, &before_);
            ++gate_.within_;
            // Either the handler sees the count, or the gate was closed before.
            is_late_ = gate_.is_closed();
        }
        ~Passage()
        {
            --gate_.within_;
            pthread_sigmask(SIG_SETMASK, &before_, nullptr);
        }
        Passage(const Passage&) = delete;
        Passage& operator=(const Passage&) = delete;

        /// True: the program is ending, and the section must not begin.
        [[nodiscard]] bool is_late() const
        {
            return is_late_;
        }
        /// The signals that this thread blocked before.
        [[nodiscard]] const sigset_t& blocked_before() const
        {
            return before_;
        }

    private:
        SignalGate& gate_;
        sigset_t before_{};
        bool is_late_ = false;
    };

    /// For the handler: all later passages are late. Waits for present ones, at most a second,
    /// because a file system may hang. Takes no lock and does not allocate.
    void close()
    {
        constexpr timespec moment = {.tv_sec = 0, .tv_nsec = 100'000};
        closed_.store(true);
        for (int i = 0; i < 10'000 && within_.load() > 0; ++i)
            nanosleep(&moment, nullptr);
    }
    [[nodiscard]] bool is_closed() const
    {
        return closed_.load();
    }

private:
    std::atomic<bool> closed_{false};
    std::atomic<int> within_{0};
};

/// For threads that are late.
[[noreturn]] inline void wait_for_the_end()
{
    while (true)
        pause();
}

}  // namespace packtrace
