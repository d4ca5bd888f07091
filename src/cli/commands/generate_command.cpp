#include "cli/command.hpp"
#include "cli/options/common_options.hpp"
#include "cli/options/validators.hpp"
#include "cli/output/output.hpp"
#include <packtrace/generate.hpp>
#include <packtrace/write_scene.hpp>

#include <limits>
#include <memory>
#include <stdexcept>
#include <string>

namespace packtrace::cli {
namespace {

template <class Options>
struct Arguments {
    PictureArguments picture{.size = "1024x1024", .depth = {}, .min_weight = {}};
    Options options;
};

// Options are limited so that a scene file does not exceed the reader's limit of keys. A sphere has
// four keys.

/// Adds a generator's command with the common options. The caller adds its own.
template <class Options>
CLI::App* add_generator(CLI::App& generate, const std::string& name, const std::string& help,
                        const std::shared_ptr<Arguments<Options>>& arguments,
                        Scene (*generator)(const Options&), const TakeScene& take)
{
    CLI::App* command = generate.add_subcommand(name, help);
    command
        ->add_option("--reflective", arguments->options.reflective,
                     "Mirrored light of the spheres, 0 to 1 (default 0)")
        ->check(share())
        ->type_name("R");
    add_size_option(*command, arguments->picture);
    command->callback([arguments, generator, take] {
        Scene scene = generator(arguments->options);
        apply(arguments->picture, scene);
        take(std::move(scene));
    });
    return command;
}

void add_radius(CLI::App& command, double& radius, const std::string& help)
{
    command.add_option("--radius", radius, help)->check(positive_number())->type_name("R");
}

void add_sphereflake(CLI::App& generate, const TakeScene& take)
{
    const auto arguments = std::make_shared<Arguments<SphereflakeOptions>>();
    CLI::App* command = add_generator(generate, "sphereflake",
                                      "Spheres that each carry nine smaller ones, recursively",
                                      arguments, generate_sphereflake, take);
    command
        ->add_option("--depth", arguments->options.depth,
                     "Generations, 0 to 6 (default 4: 7381 spheres; 6: 597871)")
        ->check(whole_number(0, 6))
        ->type_name("N");
    command->add_flag("--ground", arguments->options.ground,
                      "Add a plane to stand on, and two more lights");
}

void add_random(CLI::App& generate, const TakeScene& take)
{
    const auto arguments = std::make_shared<Arguments<RandomSpheresOptions>>();
    CLI::App* command =
        add_generator(generate, "random", "Spheres spread evenly over the unit cube", arguments,
                      generate_random_spheres, take);
    command
        ->add_option("--count", arguments->options.count,
                     "How many, up to 1990000 (default 1000000)")
        ->check(whole_number(1, 1'990'000))
        ->type_name("N");
    add_radius(*command, arguments->options.radius, "Radius of each (default 0.001)");
    command
        ->add_option("--seed", arguments->options.seed,
                     "Seed of the random positions, 0 to 2147483647 (default 1)")
        ->check(whole_number(0, std::numeric_limits<int>::max()))
        ->type_name("N");
}

void add_lattice(CLI::App& generate, const TakeScene& take)
{
    const auto arguments = std::make_shared<Arguments<LatticeOptions>>();
    CLI::App* command = add_generator(generate, "lattice", "Spheres in rows, columns and layers",
                                      arguments, generate_lattice, take);
    command
        ->add_option("--edge", arguments->options.edge,
                     "Spheres along each edge, 1 to 125 (default 10)")
        ->check(whole_number(1, 125))
        ->type_name("N");
    add_radius(*command, arguments->options.radius,
               "Radius of each, in cells: neighbours touch at 0.5 (default 0.3)");
}

}  // namespace

void add_generators(CLI::App& generate, const TakeScene& take)
{
    generate.require_subcommand(1);
    add_sphereflake(generate, take);
    add_random(generate, take);
    add_lattice(generate, take);
}

void add_generate(CLI::App& app)
{
    CLI::App* generate = app.add_subcommand("generate", "Write a procedural scene");
    const auto file = std::make_shared<std::string>();
    add_generators(*generate, [file](const Scene& scene) {
        Output output(*file);
        output.write(scene_text(scene));
        output.finish();
    });
    for (CLI::App* command : generate->get_subcommands({})) {
        command->add_option("-o,--output", *file, "Scene file (default standard output)")
            ->check(file_name())
            ->type_name("FILE");
        // Check before the work, so that a wrong name costs no time.
        command->parse_complete_callback([file] {
            if (!file->empty())
                check_writable(*file);
        });
    }
}

}  // namespace packtrace::cli
