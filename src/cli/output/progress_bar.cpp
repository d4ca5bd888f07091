#include "cli/output/progress_bar.hpp"

#include <unistd.h>

#include <cmath>
#include <iostream>
#include <string>

namespace packtrace::cli {
namespace {

constexpr std::size_t bar_width = 40;

}  // namespace

ProgressBar::ProgressBar(Verbosity verbosity)
    : wanted_(verbosity == Verbosity::normal && isatty(STDERR_FILENO) != 0),
      next_(Clock::now() + std::chrono::seconds(1))
{
}

ProgressBar::~ProgressBar()
{
    // Back to the start of the line, and clear it.
    if (drawn_)
        std::cerr << "\r\033[K" << std::flush;
}

void ProgressBar::update(double share)
{
    if (!wanted_ || Clock::now() < next_)
        return;
    drawn_ = true;
    next_ = Clock::now() + std::chrono::milliseconds(100);
    const auto filled = static_cast<std::size_t>(std::lround(share * bar_width));
    const std::string bar = std::string(filled, '#') + std::string(bar_width - filled, '.');
    std::cerr << "\r[" + bar + "] " + std::to_string(std::lround(100.0 * share)) + " %"
              << std::flush;
}

}  // namespace packtrace::cli
