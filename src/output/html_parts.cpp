#include "output/html_parts.hpp"

#include "fascicle/io/png.hpp"

namespace fascicle::output {

namespace {

const char* const style = R"(
:root { color-scheme: light dark; --page: #fff; --text: #1d2329; --dim: #5b6670; --line: #d9dee3; --soft: #f4f6f8; --accent: #b3402e; }
@media (prefers-color-scheme: dark) {
  :root { --page: #16191d; --text: #e4e8ec; --dim: #98a3ad; --line: #333a42; --soft: #1e2329; --accent: #ff8a70; }
}
* { box-sizing: border-box; }
body { margin: 0; background: var(--page); color: var(--text); font: 15px/1.5 Roboto, "Segoe UI", Helvetica, Arial, sans-serif; }
main { max-width: 1080px; margin: 0 auto; padding: 36px 24px 64px; }
h1 { font-size: 30px; line-height: 1.2; margin: 0 0 4px; overflow-wrap: anywhere; }
h2 { font-size: 19px; margin: 40px 0 12px; padding-bottom: 6px; border-bottom: 1px solid var(--line); }
p { margin: 0 0 10px; }
.dim, figcaption { color: var(--dim); }
.pictures, .plots { display: grid; grid-template-columns: repeat(2, minmax(0, 1fr)); gap: 22px; }
figure { margin: 0; break-inside: avoid; }
figure img { display: block; width: 100%; height: auto; border-radius: 6px; border: 1px solid var(--line); }
figure svg { display: block; width: 100%; height: auto; border-radius: 6px; border: 1px solid var(--line); }
figcaption { font-size: 13.5px; margin-top: 7px; }
figcaption b { color: var(--text); font-weight: 600; }
.dark { display: none; }
@media (prefers-color-scheme: dark) { .light { display: none; } .dark { display: block; } }
.bar { display: flex; align-items: center; gap: 8px; margin-top: 5px; font-size: 12.5px; }
.bar i { flex: 1; height: 9px; border-radius: 4px; }
.wide { overflow-x: auto; }
table { border-collapse: collapse; width: 100%; font-variant-numeric: tabular-nums; }
th, td { text-align: left; padding: 5px 14px 5px 0; border-bottom: 1px solid var(--line); vertical-align: top; overflow-wrap: anywhere; }
th { font-weight: 600; color: var(--dim); font-size: 13.5px; }
td.n, th.n { text-align: right; padding-right: 0; padding-left: 18px; white-space: nowrap; }
ul { margin: 0; padding-left: 20px; }
.alarm { color: var(--accent); font-weight: 600; }
footer { margin-top: 44px; font-size: 13px; color: var(--dim); }
@media (max-width: 720px) { .pictures, .plots { grid-template-columns: 1fr; } }
@media print {
  :root { --page: #fff; --text: #000; --dim: #444; --line: #bbb; --soft: #fff; --accent: #900; }
  .light { display: block; } .dark { display: none; }
  body { font-size: 11px; } main { max-width: none; padding: 0; } h2 { margin-top: 22px; break-after: avoid; }
  tr { break-inside: avoid; } table, .pictures, .plots { print-color-adjust: exact; }
}
)";

std::string base64(const std::string& bytes) {
    static const char* const digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        unsigned group = 0;
        for (std::size_t k = 0; k < 3; ++k)
            group = group << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0u);
        for (std::size_t k = 0; k < 4; ++k)
            text += i + k <= bytes.size() ? digits[group >> (18 - 6 * k) & 63] : '=';
    }
    return text;
}

} // namespace

const std::string& page_style() {
    static const std::string text = style;
    return text;
}

std::string picture_base64(const render::Image& image) {
    return base64(encode_png(image.width, image.height, image.rgba.data()));
}

std::string whole_number(std::size_t number) {
    std::string text = std::to_string(number);
    for (int at = static_cast<int>(text.size()) - 3; at > 0; at -= 3)
        text.insert(static_cast<std::size_t>(at), ",");
    return text;
}

} // namespace fascicle::output
