// run_corpus NAME FOLDER: runs a fuzzer over the files of its corpus, sorted by name.
#include "fuzzer.hpp"

#include <algorithm>
#include <cstdio>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace {

std::vector<std::filesystem::path> files_of(const char* folder)
{
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator(folder))
        if (entry.is_regular_file())
            files.push_back(entry.path());
    std::sort(files.begin(), files.end());
    return files;
}

int run(const packtrace::fuzz::Fuzzer& fuzzer, const char* folder)
{
    const auto files = files_of(folder);
    for (const auto& file : files) {
        // Printed before the run, so that the last name printed is the file that ended the program.
        std::printf("%s\n", file.filename().c_str());
        std::fflush(stdout);
        std::ifstream in(file, std::ios::binary);
        const std::string text{std::istreambuf_iterator<char>(in), {}};
        fuzzer.run({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
    }
    std::printf("%s: %zu files\n", fuzzer.name, files.size());
    return files.empty() ? 1 : 0;
}

}  // namespace

int main(int argc, char** argv)
{
    for (const auto& fuzzer : packtrace::fuzz::fuzzers())
        if (argc == 3 && std::strcmp(fuzzer.name, argv[1]) == 0)
            return run(fuzzer, argv[2]);
    std::fprintf(stderr, "usage: run_corpus NAME FOLDER\n");
    return 2;
}
