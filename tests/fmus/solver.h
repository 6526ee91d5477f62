/* The classical Runge-Kutta method with steps of at most DT, and what the instances of an FMU share. */
#include <math.h>
#include <signal.h>
#include <stdlib.h>
#include <string.h>
#include <unistd.h>

#include "model.h"
#include EQUATION_FILE

#ifndef DT
#define DT 1e-4
#endif
#define HIGHEST_ORDER 8

/* All that a state of the FMU has to hold. */
struct state {
    double t, from, p[PARAMETERS], s[MOST_STATES], u[MOST_INPUTS], du[MOST_INPUTS][HIGHEST_ORDER];
    double fault_at;
    int fault, is_held;
};

struct instance {
    struct state now;
    char label[64];
    void *environment, *logger, *update, *name;
};

enum { OK, WARNING, DISCARD, ERROR, FATAL };
enum { NO_FAULT, DISCARDS, FAILS, IS_FATAL, HANGS, CRASHES, IS_INFINITE };

static void ask_for_inputs(struct instance *own, double t);

static void inputs_at(struct instance *own, double t, double *u) {
    ask_for_inputs(own, t);
    double since = t - own->now.from;
    for (int i = 0; i < EQUATION.inputs; i++) {
        double term = 1;
        u[i] = own->now.u[i];
        for (int k = 1; k < HIGHEST_ORDER; k++) {
            term *= since / k;
            u[i] += own->now.du[i][k] * term;
        }
    }
}

static void rates_at(struct instance *own, double t, const double *s, const double *k, double h, double *r) {
    double moved[MOST_STATES], u[MOST_INPUTS];
    for (int i = 0; i < EQUATION.states; i++) moved[i] = s[i] + h * k[i];
    inputs_at(own, t, u);
    EQUATION.rates(own->now.p, moved, u, r);
}

static void internal_step(struct instance *own, double t, double h) {
    double *s = own->now.s, k[5][MOST_STATES] = {{0}};
    rates_at(own, t, s, k[0], 0, k[1]);
    rates_at(own, t + h / 2, s, k[1], h / 2, k[2]);
    rates_at(own, t + h / 2, s, k[2], h / 2, k[3]);
    rates_at(own, t + h, s, k[3], h, k[4]);
    for (int i = 0; i < EQUATION.states; i++) s[i] += h / 6 * (k[1][i] + 2 * k[2][i] + 2 * k[3][i] + k[4][i]);
}

/* The status of a step, and its fault if it is due. */
static int step(struct instance *own, double t, double h) {
    struct state *now = &own->now;
    if (fabs(t - now->t) > 1e-9 * fmax(1, fabs(t))) return ERROR;
    if (now->fault != NO_FAULT && t + h > now->fault_at) {
        switch (now->fault) {
        case DISCARDS: return DISCARD;
        case FAILS: return ERROR;
        case IS_FATAL: return FATAL;
        case HANGS: for (;;) sleep(1);
        case CRASHES: raise(SIGSEGV); break;
        case IS_INFINITE: now->s[0] = INFINITY;
        }
    }
    if (!now->is_held) {
        int count = (int)fmax(1, ceil(h / DT * (1 - 1e-9)));
        for (int i = 0; i < count; i++) internal_step(own, t + h * i / count, h / count);
    }
    now->t = t + h;
    return OK;
}

static void take_defaults(struct instance *own) {
    memcpy(own->now.p, EQUATION.parameters_at_start, sizeof own->now.p);
    memcpy(own->now.s, EQUATION.states_at_start, sizeof own->now.s);
}

static void start(struct instance *own, double t) { own->now.t = own->now.from = t; }

static int get(struct instance *own, const unsigned *vr, size_t n, double *values) {
    double y[MOST_OUTPUTS];
    EQUATION.outputs_of(own->now.p, own->now.s, own->now.u, y);
    for (size_t i = 0; i < n; i++) {
        if (vr[i] >= OUTPUT) values[i] = y[vr[i] - OUTPUT];
        else if (vr[i] >= INPUT) values[i] = own->now.u[vr[i] - INPUT];
        else if (vr[i] >= STATE) values[i] = own->now.s[vr[i] - STATE];
        else values[i] = own->now.p[vr[i]];
    }
    return OK;
}

static int set(struct instance *own, const unsigned *vr, size_t n, const double *values) {
    for (size_t i = 0; i < n; i++) {
        if (vr[i] == FAULT_AT) own->now.fault_at = values[i];
        else if (vr[i] >= INPUT) own->now.u[vr[i] - INPUT] = values[i];
        else if (vr[i] >= STATE) own->now.s[vr[i] - STATE] = values[i];
        else own->now.p[vr[i]] = values[i];
    }
    return OK;
}
