/*
 * Reference solver: buildings that collide in an earthquake, in quadruple precision.
 *
 *   gcc -O2 -o reference *.c -lquadmath -lm        (in this folder)
 *   ./reference INPUT OUTPUT [--stages N] [--tolerance T] [--proof] [--made-by TEXT]
 *
 * Writes OUTPUT.displacements.csv (with velocities and energies) and OUTPUT.impacts.csv; where storeys can yield,
 * OUTPUT.storeys.csv and OUTPUT.yields.csv as well. INPUT "-" is standard input.
 *
 * With --proof the scene is solved again with fewer stages and a looser tolerance; how far the two agree is printed and
 * written into the files. The exit code is 1 where impacts or yields differ, or where the energy balance does not close.
 * A third run, with every record sample and initial value changed by one part in 1e18, up or down at random, gives the
 * column `sensitivity`: the largest change of a displacement so far, as a part of the largest of all, in parts of 1e18.
 * Errors of any method grow like that: at a sensitivity of 1e6, nothing computed with 16 digits can be expected to agree
 * to 1e-12. TEXT goes into the first line of the files.
 *
 * Solved: M u'' + C u' + K u = -M 1 a(t) + contact forces, u relative to the ground (of floors on a foundation that moves:
 * relative to that, see foundation.c), with dense K and C in physical coordinates, by Gauss-Legendre collocation. Plastic
 * drifts p of storeys that yield add forces (1 - ratio) k p that drive their floors apart; so does gravity on storeys that
 * lean, weight / height times what their floors have moved apart. See README.md for the method.
 *
 * Input: one statement a line, words separated by blanks, # begins a comment. Numbers are decimal, each becomes the
 * nearest double and is exact from there on. SI units. Floors count from 1 at the bottom.
 *
 *   stop 20                        end, s; the start is 0
 *   output_step 0.5                s; rows at its multiples and at the end
 *   record PATH                    CSV with the columns time_s,accel_m_s2; optional
 *   scale 1                        factor on the record; or: pga 4.9
 *   min_approach_velocity 1e-4     floor on V in hertz_damped
 *   building 2 west                number of floors and name; buildings from left to right, the first one is `left` and the
 *                                  second one `right` where they have no names. Then about it:
 *     mass 3.65 3.65
 *     stiffness 2910 2910          per storey (shear building), or one line per row of the matrix:
 *     stiffness_row 5820 -2910
 *     yield_force 40 inf           per storey, after stiffness; inf: stays elastic; optional. Then, optional:
 *     post_yield_ratio 0.05 0      stiffness after yield over that before, per storey; else 0
 *     gravity_load 36 36           N per floor, weights that lean on the storeys below; optional, else those of the masses
 *     lean 3 inf                   m, heights of the storeys that gravity pushes on as they lean; inf: not this one;
 *                                  optional; after mass and gravity_load
 *     collapse_drift_ratio 0.5     share of its height by which a storey that leans and can yield has collapsed, which ends
 *                                  the run; optional, else never; after lean and yield_force
 *     damping ratio 0.01           the same in every mode of the building under gravity; after mass, stiffness and lean
 *     damping ratios 0.01 0.02     per mode, lowest first
 *     damping rayleigh 0.05 1 2    ratio and two modes
 *     damping dashpots 10 8        N s/m, per storey
 *     damping_row 10 -5            one line per row of the matrix
 *     height 3 3                   m, of every storey; only before rocking
 *     sway 40e3 9e7 2e6            the foundation sways: its mass, kg, spring, N/m, and dashpot, N s/m; optional
 *     rocking 9e5 2e9 1e7          and rocks: moment of inertia, kg m2, spring, N m/rad, and dashpot, N m s/rad; optional
 *     displacement 0 0.01          of the floors at the start; optional, as is velocity
 *   building 3 east                the next one on its right
 *     ...
 *   contact LEFT RIGHT GAP LAW [stiffness K] [exponent N] [restitution E] [damping_formula NAME]
 *
 * LEFT and RIGHT say what is on the left and on the right of a contact: a wall, or of a building, NAME:, the number of a
 * floor or the columns of a storey, columns:STOREY:POSITION:SHAPE with a position between 0 and 1 and the shape fixed or
 * straight. Without its name it is the first building on the left and the second one on the right. Which buildings meet is
 * not checked. Contacts follow the buildings, and so do links:
 *
 *   link LEFT RIGHT [stiffness K] [dashpot C] [slip_force V] [post_yield_ratio R]
 *
 * a spring and a dashpot side by side between floors, or a floor and a wall; floor 0 is a foundation that moves. With a
 * slip_force the spring slips as a storey yields; it needs a floor on its left then.
 */
#include "reference.h"

#include <stdio.h>
#include <stdlib.h>
#include <string.h>

typedef struct {
    const char *input, *output, *made_by;
    int stages;
    double tolerance;
    bool proof;
} Options;

static Options parse_options(int count, char **word)
{
    Options options = {.stages = 20, .tolerance = 1e-19, .made_by = "reference.c"};
    for (int i = 1; i < count; i++) {
        bool more = i + 1 < count;
        if (strcmp(word[i], "--proof") == 0)
            options.proof = true;
        else if (strcmp(word[i], "--stages") == 0 && more)
            options.stages = atoi(word[++i]);
        else if (strcmp(word[i], "--tolerance") == 0 && more)
            options.tolerance = atof(word[++i]);
        else if (strcmp(word[i], "--made-by") == 0 && more)
            options.made_by = word[++i];
        else if (!options.input)
            options.input = word[i];
        else if (!options.output)
            options.output = word[i];
        else
            fail("argument '%s' not understood", word[i]);
    }
    if (!options.output)
        fail("usage: reference INPUT OUTPUT [--stages N] [--tolerance T] [--proof] [--made-by TEXT]");
    if (options.stages < 8 || options.stages > MAX_STAGES || !(options.tolerance > 0))
        fail("8 to %d stages and a tolerance > 0", MAX_STAGES);
    return options;
}

int main(int count, char **word)
{
    static Scene scene;
    static Solution best;
    static Proof proof;
    Options options = parse_options(count, word);
    read_scene(options.input, &scene);
    solve(&scene, options.stages, options.tolerance, &best);
    print_run(&best);
    if (options.proof)
        prove(&scene, &best, &proof);
    write_files(options.output, options.made_by, &scene, &best, options.proof ? &proof : NULL);
    bool proved = proof.same_impacts && proof.same_yields && best.energy_residual < 1e-24;
    return options.proof && !proved;
}
