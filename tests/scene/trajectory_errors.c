/* SPDX-License-Identifier: MIT
 *
 * What the library says of pairs of trajectories, as truth/trajectory_truth.py says it.
 *
 * Usage: trajectory-errors TRUTH ESTIMATE [TRUTH ESTIMATE...]     one line of JSON for each two files as TUM writes them
 */
#include <cubemap/number.h>
#include <cubemap/trajectory.h>

#include <math.h>
#include <stdio.h>
#include <stdlib.h>
#include <string.h>

#define LINES_MOST 10000

static void fail(const char *path, size_t line, const char *what)
{
    fprintf(stderr, "trajectory-errors: %s: line %zu: %s\n", path, line, what);
    exit(1);
}

/* Eight numbers; 0 if the line is another. */
static int read_numbers(const char *line, double number[8])
{
    for (int i = 0; i < 8; i++)
    {
        line += strspn(line, " \t");
        const size_t length = strcspn(line, " \t\r\n");
        if (!cm_number_parse(line, length, &number[i]))
        {
            return 0;
        }
        line += length;
    }
    return line[strspn(line, " \t\r\n")] == '\0';
}

static cm_trajectory *read_trajectory(const char *path)
{
    static double stamp[LINES_MOST];
    static cm_pose pose[LINES_MOST];
    char line[1024];
    size_t count = 0;
    size_t wrong = 0;
    cm_trajectory *trajectory = NULL;
    FILE *file = fopen(path, "r");
    if (file == NULL)
    {
        fail(path, 0, "cannot be opened");
    }
    for (size_t at = 1; fgets(line, sizeof line, file) != NULL; at++)
    {
        double number[8];
        if (line[0] == '#')
        {
            continue;
        }
        if (count == LINES_MOST || !read_numbers(line, number) ||
            cm_pose_from_quaternion(number + 1, number + 4, &pose[count]) != CM_OK)
        {
            fail(path, at, "is no pose");
        }
        stamp[count++] = number[0];
    }
    fclose(file);
    const cm_status status = cm_trajectory_create(count, stamp, pose, &trajectory, &wrong);
    if (status != CM_OK)
    {
        fail(path, wrong, cm_status_text(status));
    }
    return trajectory;
}

static void print_number(const char *name, double value)
{
    char digits[CM_NUMBER_SIZE];
    cm_number_write_shortest(value, digits);
    printf(", \"%s\": %s", name, isfinite(value) ? digits : "null");
}

int main(int count, char **arguments)
{
    for (int i = 1; i + 1 < count; i += 2)
    {
        cm_trajectory *truth = read_trajectory(arguments[i]);
        cm_trajectory *estimate = read_trajectory(arguments[i + 1]);
        cm_evaluation made = {.size = sizeof made};
        const cm_status status = cm_trajectory_evaluate(truth, estimate, NULL, &made);
        if (status != CM_OK)
        {
            fail(arguments[i + 1], 0, cm_status_text(status));
        }
        printf("{\"pairs\": %zu, \"motions\": %zu", made.pairs, made.motions);
        print_number("ate_rmse", made.ate_rmse);
        print_number("rpe_translation_rmse", made.rpe_translation_rmse);
        print_number("rpe_rotation_rmse_degrees", made.rpe_rotation_rmse_degrees);
        printf(", \"rank_deficient\": %s}\n", made.is_determined ? "false" : "true");
        cm_trajectory_destroy(truth);
        cm_trajectory_destroy(estimate);
    }
    return 0;
}
