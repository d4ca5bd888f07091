// Jobs on a background thread, which writes frames while the next frames are rendered.
#include "catch.hpp"
#include "core/job_queue.hpp"

#include <future>
#include <stdexcept>
#include <vector>

namespace packtrace::test {

TEST_CASE("jobs run in the order they come", "[job_queue]")
{
    std::vector<int> done;
    JobQueue jobs;
    for (int i = 0; i < 100; ++i)
        jobs.add([&done, i] { done.push_back(i); });
    jobs.finish();
    REQUIRE(done.size() == 100);
    for (int i = 0; i < 100; ++i)
        CHECK(done[static_cast<std::size_t>(i)] == i);
    CHECK(jobs.seconds() > 0.0);
}

TEST_CASE("other work continues while a job runs", "[job_queue]")
{
    std::promise<void> go_on;
    bool second = false;
    JobQueue jobs;
    // The first job ends only after the second has been added.
    jobs.add([&] { go_on.get_future().wait(); });
    jobs.add([&] { second = true; });
    go_on.set_value();
    jobs.finish();
    CHECK(second);
}

TEST_CASE("an exception of a job reaches the caller who adds the next job or finishes",
          "[job_queue]")
{
    int done = 0;
    JobQueue jobs;
    jobs.add([] { throw std::runtime_error("disk full"); });
    const auto add_many = [&] {
        for (int i = 0; i < 100; ++i)
            jobs.add([&] { ++done; });
    };
    CHECK_THROWS_WITH(add_many(), "disk full");
    CHECK_THROWS_WITH(jobs.finish(), "disk full");
    CHECK(done == 0);
}

TEST_CASE("added jobs still run if their queue is destroyed early", "[job_queue]")
{
    int done = 0;
    {
        JobQueue jobs;
        jobs.add([&] { ++done; });
        jobs.add([&] { ++done; });
    }
    CHECK(done == 2);
}

}  // namespace packtrace::test
