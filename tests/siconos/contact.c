/*
 * Equations of motion and contact relations of the problems of run.py, as a plugin of Siconos.
 *
 *     cc -O2 -shared -fPIC -o contact.so contact.c -lm
 *
 * Siconos finds the functions by name. A Lagrangian system reads
 *
 *     M(q) dv/dt + F(t, q, v) = H(q)^T lambda,
 *
 * with F = "FInt" in the words of Siconos: gyroscopic terms, weight and loads all go there. A contact has the output
 * (gap, tangential displacement), or the gap alone without friction; H is its Jacobian, stored column by column.
 *
 * A problem NAME exports
 *     NAME              its parameters, one double each
 *     NAME_parameters   the names of the parameters in this order, each followed by one space
 *     NAME_mass, NAME_force, NAME_potential
 *     NAME_gap_K, NAME_jacobian_K for the contacts K = 1, 2, ..
 * and, if the forces depend on the motion, NAME_force_dq and NAME_force_dv.
 */

#include <math.h>

#define FIELD(name) double name;
#define NAME(name) #name " "

/* The signatures that Siconos asks for. The vector z of a system (length nz) is not used here. */
#define MASS(name) \
    void name(unsigned int n, const double *q, double *M, unsigned int nz, double *z)
#define FORCE(name) \
    void name(double t, unsigned int n, const double *q, const double *v, double *F, unsigned int nz, double *z)
#define RELATION(name) \
    void name(unsigned int n, const double *q, unsigned int ny, double *y, unsigned int nz, double *z)
#define UNUSED_Z (void)nz, (void)z

/* -------------------------------------------------------------------------------------------------------------------
 * Verdicts of the contact solver. Siconos only prints a warning when its solver fails, and the Lemke solver for plane
 * friction reports success whatever it has reached. Siconos calls count_solver_call after each solution.
 */

long solver_calls = 0;
long solver_failures = 0;
double *solver_residual = 0; /* where the solver leaves its residual; may be null */
double solver_tolerance = 0;

void count_solver_call(int info, void *simulation)
{
    (void)simulation;
    solver_calls += 1;
    /* Negated, so that a residual that is not a number counts as a failure. */
    int failed = info != 0 || (solver_residual && !(*solver_residual <= solver_tolerance));
    solver_failures += failed;
    if (solver_residual)
        *solver_residual = 0; /* without a closed contact the solver does not run and leaves the old value */
}

/* -------------------------------------------------------------------------------------------------------------------
 * A ball above a floor. q = height of its lowest point. One contact without friction.
 */

#define BALL_PARAMETERS(X) X(m) X(g)

struct {
    BALL_PARAMETERS(FIELD)
} ball;
const char *const ball_parameters = BALL_PARAMETERS(NAME);

MASS(ball_mass)
{
    (void)n, (void)q, UNUSED_Z;
    M[0] = ball.m;
}

FORCE(ball_force)
{
    (void)t, (void)n, (void)q, (void)v, UNUSED_Z;
    F[0] = ball.m * ball.g;
}

double ball_potential(const double *q)
{
    return ball.m * ball.g * q[0];
}

RELATION(ball_gap_1)
{
    (void)n, (void)ny, UNUSED_Z;
    y[0] = q[0];
}

RELATION(ball_jacobian_1)
{
    (void)n, (void)q, (void)ny, UNUSED_Z;
    y[0] = 1;
}

/* -------------------------------------------------------------------------------------------------------------------
 * A rectangular block of width 2 b and height 2 h on a slope. q = (x, y, phi): centre of mass along the slope
 * (downwards) and normal to it, and the angle of the block against the slope. Contacts: corner 1 at (-b, -h) and
 * corner 2 at (b, -h) of the block. With slope = 0 this is the rocking block.
 */

#define BLOCK_PARAMETERS(X) X(b) X(h) X(m) X(J) X(g) X(slope)

struct {
    BLOCK_PARAMETERS(FIELD)
} block;
const char *const block_parameters = BLOCK_PARAMETERS(NAME);

MASS(block_mass)
{
    (void)q, UNUSED_Z;
    for (unsigned int i = 0; i < n * n; ++i)
        M[i] = 0;
    M[0] = M[4] = block.m;
    M[8] = block.J;
}

FORCE(block_force)
{
    (void)t, (void)n, (void)q, (void)v, UNUSED_Z;
    F[0] = -block.m * block.g * sin(block.slope);
    F[1] = block.m * block.g * cos(block.slope);
    F[2] = 0;
}

double block_potential(const double *q)
{
    return block.m * block.g * (q[1] * cos(block.slope) - q[0] * sin(block.slope));
}

static void block_corner(double side, const double *q, double *y)
{
    double cx = side * block.b, cy = -block.h, s = sin(q[2]), c = cos(q[2]);
    y[0] = q[1] + cx * s + cy * c;
    y[1] = q[0] + cx * c - cy * s;
}

static void block_corner_jacobian(double side, const double *q, double *H)
{
    double cx = side * block.b, cy = -block.h, s = sin(q[2]), c = cos(q[2]);
    H[0] = 0, H[2] = 1, H[4] = cx * c - cy * s;
    H[1] = 1, H[3] = 0, H[5] = -cx * s - cy * c;
}

#define BLOCK_CONTACT(k, side)             \
    RELATION(block_gap_##k)                \
    {                                      \
        (void)n, (void)ny, UNUSED_Z;       \
        block_corner(side, q, y);          \
    }                                      \
    RELATION(block_jacobian_##k)           \
    {                                      \
        (void)n, (void)ny, UNUSED_Z;       \
        block_corner_jacobian(side, q, y); \
    }

BLOCK_CONTACT(1, -1.0)
BLOCK_CONTACT(2, 1.0)

/* -------------------------------------------------------------------------------------------------------------------
 * Slider-crank with clearance between the slider and its guide. q = (theta1, theta2, theta3): crank and rod against
 * the axis of the guide, and the slider. The slider of length 2 a and height 2 b has its centre of mass at the end of
 * the rod; the guide has the height 2 (b + c). Corners: 1 upper left, 2 upper right, 3 lower left, 4 lower right.
 * J1, J2: about the centres of crank and rod. A constant torque acts on the crank, gravity along -y.
 */

#define CRANK_PARAMETERS(X) \
    X(l1) X(l2) X(a) X(b) X(c) X(m1) X(m2) X(m3) X(J1) X(J2) X(J3) X(g) X(torque)

struct {
    CRANK_PARAMETERS(FIELD)
} crank;
const char *const crank_parameters = CRANK_PARAMETERS(NAME);

static double crank_coupling(void)
{
    return (crank.m2 / 2 + crank.m3) * crank.l1 * crank.l2;
}

/* Weight moments: V = weight1 sin(theta1) + weight2 sin(theta2). */
static double crank_weight1(void)
{
    return crank.g * crank.l1 * (crank.m1 / 2 + crank.m2 + crank.m3);
}

static double crank_weight2(void)
{
    return crank.g * crank.l2 * (crank.m2 / 2 + crank.m3);
}

MASS(crank_mass)
{
    (void)n, UNUSED_Z;
    double m12 = crank_coupling() * cos(q[0] - q[1]);
    M[0] = crank.J1 + (crank.m1 / 4 + crank.m2 + crank.m3) * crank.l1 * crank.l1;
    M[4] = crank.J2 + (crank.m2 / 4 + crank.m3) * crank.l2 * crank.l2;
    M[8] = crank.J3;
    M[1] = M[3] = m12;
    M[2] = M[5] = M[6] = M[7] = 0;
}

FORCE(crank_force)
{
    (void)t, (void)n, UNUSED_Z;
    double s = crank_coupling() * sin(q[0] - q[1]);
    F[0] = s * v[1] * v[1] + crank_weight1() * cos(q[0]) - crank.torque;
    F[1] = -s * v[0] * v[0] + crank_weight2() * cos(q[1]);
    F[2] = 0;
}

FORCE(crank_force_dq)
{
    (void)t, UNUSED_Z;
    double c = crank_coupling() * cos(q[0] - q[1]);
    for (unsigned int i = 0; i < n * n; ++i)
        F[i] = 0;
    F[0] = c * v[1] * v[1] - crank_weight1() * sin(q[0]);
    F[3] = -c * v[1] * v[1];
    F[1] = -c * v[0] * v[0];
    F[4] = c * v[0] * v[0] - crank_weight2() * sin(q[1]);
}

FORCE(crank_force_dv)
{
    (void)t, UNUSED_Z;
    double s = crank_coupling() * sin(q[0] - q[1]);
    for (unsigned int i = 0; i < n * n; ++i)
        F[i] = 0;
    F[3] = 2 * s * v[1];
    F[1] = -2 * s * v[0];
}

double crank_potential(const double *q)
{
    return crank_weight1() * sin(q[0]) + crank_weight2() * sin(q[1]) - crank.torque * q[0];
}

/* The corner (side a, level b) of the slider; the gap is measured to the wall on its own side of the guide. */
static void crank_corner(double side, double level, const double *q, double *y)
{
    double cx = side * crank.a, cy = level * crank.b, s = sin(q[2]), c = cos(q[2]);
    double px = crank.l1 * cos(q[0]) + crank.l2 * cos(q[1]) + cx * c - cy * s;
    double py = crank.l1 * sin(q[0]) + crank.l2 * sin(q[1]) + cx * s + cy * c;
    y[0] = crank.b + crank.c - level * py;
    y[1] = px;
}

static void crank_corner_jacobian(double side, double level, const double *q, double *H)
{
    double cx = side * crank.a, cy = level * crank.b, s = sin(q[2]), c = cos(q[2]);
    H[0] = -level * crank.l1 * cos(q[0]), H[1] = -crank.l1 * sin(q[0]);
    H[2] = -level * crank.l2 * cos(q[1]), H[3] = -crank.l2 * sin(q[1]);
    H[4] = -level * (cx * c - cy * s), H[5] = -cx * s - cy * c;
}

#define CRANK_CONTACT(k, side, level)             \
    RELATION(crank_gap_##k)                       \
    {                                             \
        (void)n, (void)ny, UNUSED_Z;              \
        crank_corner(side, level, q, y);          \
    }                                             \
    RELATION(crank_jacobian_##k)                  \
    {                                             \
        (void)n, (void)ny, UNUSED_Z;              \
        crank_corner_jacobian(side, level, q, y); \
    }

CRANK_CONTACT(1, -1.0, 1.0)
CRANK_CONTACT(2, 1.0, 1.0)
CRANK_CONTACT(3, -1.0, -1.0)
CRANK_CONTACT(4, 1.0, -1.0)
