// SPDX-License-Identifier: MIT
//
// Cases of the image programs, which run in this process: each ends in a line "ok NUMBER - NAME", or
// "not ok NUMBER - NAME" and what was seen.

#ifndef TESTS_IMAGE_CASES_HPP
#define TESTS_IMAGE_CASES_HPP

#include <cstdio>
#include <functional>
#include <string>
#include <vector>

// What a program has written and returned. Bytes that a library wrote to the descriptors 1 and 2 of
// the process are at the end of what belongs there.
struct Ran
{
    int status = 0;
    std::string out;
    std::string err;
};

using Words = std::vector<std::string>;

// The words of a line, between blanks; 'what is in quotes' is one.
Words words_of(const std::string &line);

// Runs a program; the first word is its name without "cubemap-".
Ran run(const Words &words);
Ran run(const std::string &line);

// The same with that on standard input; what is written to standard output goes to out, if that is not nullptr.
Ran run_with_input(const std::string &input, const std::string &line, std::FILE *out = nullptr);

// While it lives, no file that a program writes may be longer.
class SizeLimit
{
public:
    explicit SizeLimit(unsigned bytes);
    ~SizeLimit();
    SizeLimit(const SizeLimit &) = delete;
    SizeLimit &operator=(const SizeLimit &) = delete;
};

void result(bool good, const std::string &name, const std::string &seen = "");

// A check throws what is wrong.
void holds(const std::string &name, const std::function<void()> &check);

// The program must succeed and say nothing on standard error. Returns what it wrote.
Ran passes(const std::string &name, const std::string &line);

// The program must end with that status and one line on standard error that matches the words, a
// regular expression, write nothing to standard output, and leave nothing in the folder "made".
void fails(const std::string &name, int status, const std::string &expression, const Words &words);
void fails(const std::string &name, int status, const std::string &expression,
           const std::string &line);

// What a case needs: as passes(), but only a failure counts.
Ran does(const std::string &line);

// The same, and what it writes to standard output matches.
void says(const std::string &name, const std::string &expression, const std::string &line);

bool matches(const std::string &text, const std::string &extended_regular_expression);

// Is this compiled with sanitizers, which keep memory that was given back?
bool is_sanitized();

std::string content_of(const std::string &name);
void write_file(const std::string &name, const std::string &content);
bool same_content(const std::string &one, const std::string &other);
// The names in a folder, sorted, with a blank behind each.
std::string names_in(const std::string &folder);
// A binary PPM of random bytes; always the same ones for the same size.
void make_noise(int width, int height, const std::string &name);
// The same with its pixels in the opposite order.
void make_turned(const std::string &noise, int width, int height, const std::string &name);

// From now on programs find the library for rasters of GDAL; false if it is not built.
bool open_gdal();

// The top of the source tree.
const std::string &source_tree();

// Where all is slow, one in so many; elsewhere 1.
int one_in(int many);

// A group of cases, which begins in an empty folder of its own.
struct Subject
{
    const char *name;
    void (*run)();
};

const std::vector<Subject> &compare_subjects();
const std::vector<Subject> &reproject_subjects();
const std::vector<Subject> &reproject_chart_subjects();
const std::vector<Subject> &reproject_pixel_subjects();
const std::vector<Subject> &reproject_mistake_subjects();
const std::vector<Subject> &reproject_surface_subjects();
const std::vector<Subject> &reproject_tag_subjects();
const std::vector<Subject> &reproject_raster_subjects();
const std::vector<Subject> &reproject_output_subjects();
const std::vector<Subject> &reproject_tile_subjects();
const std::vector<Subject> &reproject_stream_subjects();
const std::vector<Subject> &reproject_memory_subjects();
const std::vector<Subject> &distortion_subjects();
const std::vector<Subject> &orient_subjects();
const std::vector<Subject> &colormap_subjects();
const std::vector<Subject> &scene_subjects();
const std::vector<Subject> &scene_motion_subjects();
const std::vector<Subject> &scene_refusal_subjects();
const std::vector<Subject> &octree_subjects();
const std::vector<Subject> &octree_run_subjects();
const std::vector<Subject> &tof_subjects();
const std::vector<Subject> &tof_refusal_subjects();
const std::vector<Subject> &tof_environment_subjects();
const std::vector<Subject> &tof_evaluate_subjects();

#endif
