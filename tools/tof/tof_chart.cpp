// SPDX-License-Identifier: MIT

#include "tof_chart.hpp"

#include <array>
#include <cmath>
#include <cstdio>
#include <filesystem>

#include <sys/wait.h>
#include <unistd.h>

std::string json_text(const std::string &text)
{
    std::string made = "\"";
    for (const char c : text)
    {
        made += c == '"' || c == '\\' ? std::string("\\") + c : std::string(1, c);
    }
    return made + "\"";
}

std::string text_of_number(double value, int digits)
{
    std::array<char, 40> text = {};
    std::snprintf(text.data(), text.size(), "%.*g", digits, value);
    return text.data();
}

namespace
{

template <class Number> std::string list_of(const std::vector<Number> &values)
{
    std::string made = "[";
    for (const Number value : values)
    {
        made += made.size() > 1 ? "," : "";
        made += std::isfinite(value) ? text_of_number(static_cast<double>(value), 9) : "null";
    }
    return made + "]";
}

std::string list_of(const std::vector<std::string> &words)
{
    std::string made = "[";
    for (const std::string &word : words)
    {
        made += (&word == words.data() ? "" : ",") + json_text(word);
    }
    return made + "]";
}

std::string chart_json(const Chart &chart)
{
    std::string made = "{\"name\":" + json_text(chart.name) +
                       ",\"title\":" + json_text(chart.title) + ",\"x\":" + json_text(chart.x) +
                       ",\"y\":" + json_text(chart.y) +
                       ",\"scatter\":" + (chart.is_scatter ? "true" : "false") +
                       ",\"logarithmic\":" + (chart.is_logarithmic ? "true" : "false") +
                       ",\"ticks\":" + list_of(chart.tick) + ",\"curves\":[";
    for (const ChartCurve &curve : chart.curves)
    {
        made += &curve == chart.curves.data() ? "" : ",";
        made += "{\"name\":" + json_text(curve.name) + ",\"x\":" + list_of(curve.x) +
                ",\"y\":" + list_of(curve.y) + ",\"mark\":" + list_of(curve.mark) + "}";
    }
    made += "],\"pictures\":[";
    for (const ChartPicture &picture : chart.pictures)
    {
        made += &picture == chart.pictures.data() ? "" : ",";
        made += "{\"name\":" + json_text(picture.name) + ",\"unit\":" + json_text(picture.unit) +
                ",\"width\":" + std::to_string(picture.width) +
                ",\"value\":" + list_of(picture.value) + "}";
    }
    return made + "]}";
}

// Where the script is that draws: beside what is installed, or among the sources.
std::string chart_script()
{
    for (const char *const path : {CM_TOF_CHART_INSTALLED, CM_TOF_CHART_SOURCE})
    {
        if (std::filesystem::exists(path))
        {
            return path;
        }
    }
    return "";
}

// Did it draw? The system's Python has the system's matplotlib, where another comes first.
bool draws(const char *python, const std::string &script, const std::string &json,
           const std::string &folder)
{
    const pid_t child = fork();
    if (child == 0)
    {
        execlp(python, python, script.c_str(), json.c_str(), folder.c_str(),
               static_cast<char *>(nullptr));
        _exit(127);
    }
    int status = 0;
    return child > 0 && waitpid(child, &status, 0) == child && WIFEXITED(status) &&
           WEXITSTATUS(status) == 0;
}

} // namespace

std::string charts_json(const std::vector<Chart> &charts)
{
    std::string text = "[";
    for (const Chart &chart : charts)
    {
        text += &chart == charts.data() ? "\n" : ",\n";
        text += chart_json(chart);
    }
    return text + "]";
}

bool draw_charts(const std::string &json, const std::string &folder)
{
    const std::string script = chart_script();
    return !script.empty() && (draws("python3", script, json, folder) ||
                               draws("/usr/bin/python3", script, json, folder));
}
