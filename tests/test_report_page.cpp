// report.html in a real browser.
#include "browser.hpp"
#include "catch.hpp"
#include "scenes.hpp"
#include <packtrace/isa.hpp>
#include <packtrace/report.hpp>
#include <packtrace/write_report.hpp>

#include <nlohmann/json.hpp>

#include <regex>
#include <set>
#include <string>
#include <vector>

namespace packtrace::test {
namespace {

/// Writes the report of a small scene, and returns its page.
std::string write_page(const TempFolder& folder)
{
    const ReportOptions options{.threads = {1},
                                .isas = {choose_isa().name},
                                .min_weights = {0.1, 0.0},
                                .samples = {1, 4},
                                .adaptive = {{4, 0.1}},
                                .repetitions = 1,
                                .truth_samples = 8,
                                .classified = 4};
    const SceneReport scene = report({"four <spheres>", four_spheres(96, 64)}, options);
    write_report({scene}, options, {"p", 1, "c", "x", "cmd"}, folder / "out");
    return (folder / "out" / "report.html").string();
}

/// Operates the page as a user does, and writes the observations into an element.
const std::string user = R"js(<script>
addEventListener('load', async () => {
    const seen = {};
    const slider = document.querySelector('.slider');
    const range = slider.querySelector('input[type=range]');
    const [left, right] = slider.querySelectorAll('.compare img');
    await Promise.all([left.decode(), right.decode()]);
    seen.ready = document.documentElement.dataset.ready;
    seen.width = left.naturalWidth;
    seen.height = right.naturalHeight;
    seen.overlaid = left.getBoundingClientRect().left === right.getBoundingClientRect().left;
    seen.before = getComputedStyle(right).clipPath;
    range.value = 80;
    range.dispatchEvent(new Event('input'));
    seen.after = getComputedStyle(right).clipPath;
    const choices = slider.querySelectorAll('select');
    seen.choices = choices[0].options.length;
    seen.names = [...choices[0].options].map(option => option.textContent);
    const scales = [...slider.querySelectorAll('.scale')];
    seen.scales = scales.map(scale => getComputedStyle(scale).display !== 'none');
    seen.most = Number(scales[1].querySelector('.most').textContent);
    seen.narrow = document.documentElement.scrollWidth <= innerWidth;
    const old = left.src;
    choices[0].selectedIndex = choices[0].options.length - 1;
    choices[0].dispatchEvent(new Event('change'));
    await left.decode();
    seen.changed = left.src !== old && left.naturalWidth === 96;
    seen.scaleOfLeft = getComputedStyle(scales[0]).display !== 'none';
    const labels = [...document.querySelectorAll('.plot svg')].flatMap(svg => {
        const texts = [...svg.querySelectorAll('g[id^=gnuplot_plot_] text')]
            .map(text => text.getBoundingClientRect()).filter(box => box.width > 0);
        return texts.flatMap((a, i) => texts.slice(i + 1).filter(b =>
            a.left < b.right - 1 && b.left < a.right - 1 &&
            a.top < b.bottom - 3 && b.top < a.bottom - 3));
    });
    seen.labelsOnLabels = labels.length;
    const plots = [...document.querySelectorAll('.plot')];
    seen.plots = plots.length;
    seen.drawn = plots.every(plot =>
        plot.querySelector('svg').getBoundingClientRect().height > 100);
    const box = plots[0].querySelectorAll('label input')[1];
    const group = plots[0].querySelector('#' + box.dataset.groups.split(' ')[0]);
    const colorOf = label => [
        getComputedStyle(label.querySelector('.swatch')).backgroundColor,
        getComputedStyle(plots[0].querySelector(
            `#${label.querySelector('input').dataset.groups.split(' ')[0]} path`)).stroke];
    seen.colors = [...plots[0].querySelectorAll('label')].map(colorOf);
    seen.marks = group.querySelectorAll('use, path, circle').length;
    const shown = () => group.getBoundingClientRect().width > 0;
    seen.shown = shown();
    box.click();
    seen.hidden = !shown();
    box.click();
    seen.shownAgain = shown();
    const result = document.createElement('output');
    result.id = 'seen';
    result.textContent = JSON.stringify(seen);
    document.body.append(result);
});
</script></body>)js";

const std::string seen_start = "<output id=\"seen\">";

nlohmann::json what_was_seen(const std::string& dom)
{
    const std::size_t at = dom.find(seen_start);
    REQUIRE(at != std::string::npos);
    const std::size_t from = at + seen_start.size();
    return nlohmann::json::parse(dom.substr(from, dom.find("</output>", from) - from));
}

}  // namespace

TEST_CASE("the page escapes special characters in names", "[report_page]")
{
    const TempFolder folder;
    const std::string page = read_text(write_page(folder));
    CHECK_THAT(page, ContainsSubstring("<h2>four &lt;spheres>, 96 x 64</h2>"));
    CHECK(page.find("<spheres>,") == std::string::npos);
}

TEST_CASE("the page agrees with the other files of a report", "[report_page]")
{
    const TempFolder folder;
    const std::string page = read_text(write_page(folder));
    for (const char* part : {"<meta name=\"viewport\"", "<th>Mrays/s</th>", "<th>PSNR, dB</th>",
                             "<optgroup label=\"arithmetic: heat maps of errors\">",
                             ">error of scalar single, 1 thread", "<details><summary>How to read"})
        CHECK_THAT(page, ContainsSubstring(part));
}

TEST_CASE("the page shows its pictures without a script", "[report_page]")
{
    const TempFolder folder;
    const std::string page = read_text(write_page(folder));
    std::size_t pictures = 0;
    for (std::size_t at = page.find("<img "); at != std::string::npos;
         at = page.find("<img ", at + 1), ++pictures) {
        const std::string element = page.substr(at, page.find('>', at) - at);
        CHECK_THAT(element, ContainsSubstring("src=\"data:image/png;base64,"));
        CHECK_THAT(element, ContainsSubstring("alt=\""));
    }
    CHECK(pictures == 2);
}

TEST_CASE("no id occurs twice on the page, and every reference of the plots exists",
          "[report_page]")
{
    const TempFolder folder;
    const std::string page = read_text(write_page(folder));
    const auto all_of = [&](const std::string& pattern) {
        std::vector<std::string> found;
        const std::regex regex(pattern);
        for (std::size_t at = page.find("<svg"); at != std::string::npos;
             at = page.find("<svg", at + 1)) {
            const std::string plot = page.substr(at, page.find("</svg>", at) - at);
            for (std::sregex_iterator match(plot.begin(), plot.end(), regex), end; match != end;
                 ++match)
                found.push_back((*match)[1]);
        }
        return found;
    };
    const std::vector<std::string> ids = all_of(" id=['\"]([^'\"]*)");
    const std::set<std::string> distinct(ids.begin(), ids.end());
    CHECK(ids.size() > 20);
    CHECK(distinct.size() == ids.size());
    for (const std::string& target : all_of("href=['\"]#([^'\"]*)"))
        CHECK(distinct.count(target) == 1);
}

TEST_CASE("the page opens in a browser without an error, and its slider and plots work",
          "[report_page][slow]")
{
    const std::string name = browser();
    REQUIRE(!name.empty());  // apt-get install chromium
    const TempFolder folder;
    const std::string file = write_page(folder);
    const PageResult plain = open_page(name, folder, file);
    CHECK_THAT(plain.dom, ContainsSubstring("data-ready=\"yes\""));
    CHECK(plain.console.empty());

    std::string page = read_text(file);
    page.replace(page.rfind("</body>"), 7, user);
    write_text(file, page);
    // The browser's virtual time continues while pictures are decoded: on a busy machine it may end
    // before the page is done.
    PageResult used = open_page(name, folder, file);
    for (int again = 0; again < 3 && used.dom.find(seen_start) == std::string::npos; ++again)
        used = open_page(name, folder, file);
    CHECK(used.console.empty());
    const nlohmann::json seen = what_was_seen(used.dom);
    CAPTURE(seen.dump(2));
    CHECK(seen["ready"] == "yes");
    CHECK(seen["width"] == 96);
    CHECK(seen["height"] == 64);
    CHECK(seen["overlaid"] == true);
    CHECK(seen["before"] == "inset(0px 0px 0px 50%)");
    CHECK(seen["after"] == "inset(0px 0px 0px 80%)");
    CHECK(seen["choices"] >= 8);
    CHECK(seen["changed"] == true);
    CHECK(seen["names"][0] == "truth");
    for (const auto& entry : seen["names"])
        CHECK(entry.get<std::string>().find(".png") == std::string::npos);
    // At first only the picture on the right is a heat map; later both are.
    CHECK(seen["scales"] == nlohmann::json{false, true});
    CHECK(seen["scaleOfLeft"] == true);
    CHECK(seen["most"] > 0.0);
    CHECK(seen["narrow"] == true);
    CHECK(seen["labelsOnLabels"] == 0);
    CHECK(seen["plots"] == 4);
    CHECK(seen["drawn"] == true);
    CHECK(seen["marks"] >= 1);
    CHECK(seen["colors"].size() >= 3);
    for (const auto& colors : seen["colors"])
        CHECK(colors[0] == colors[1]);
    CHECK(seen["shown"] == true);
    CHECK(seen["hidden"] == true);
    CHECK(seen["shownAgain"] == true);
}

TEST_CASE("a page with an error is detected", "[report_page][slow]")
{
    const std::string name = browser();
    REQUIRE(!name.empty());  // apt-get install chromium
    const TempFolder folder;
    write_text(folder / "bad.html", "<html><script>nothing.at.all();</script></html>");
    CHECK_THAT(open_page(name, folder, (folder / "bad.html").string()).console,
               ContainsSubstring("nothing is not defined"));
}

}  // namespace packtrace::test
