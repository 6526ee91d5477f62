/* FMI 3.0 around the solver. UPDATES: inputs are asked for at every stage; STATES. */
#include <stdbool.h>
#include <stdint.h>

#include "solver.h"

typedef void (*logger)(void *, int, const char *, const char *);
typedef void (*updater)(void *, double, bool, bool, bool, bool, bool *, double *);

static void ask_for_inputs(struct instance *own, double t) {
    bool early = false;
    double when = 0;
    if (own->update) ((updater)own->update)(own->environment, t, true, false, false, false, &early, &when);
}

void *fmi3InstantiateCoSimulation(const char *name, const char *token, const char *resources, bool visible,
                                  bool logging, bool events, bool early, const unsigned *inside, size_t n,
                                  void *environment, logger log, updater update) {
    (void)name, (void)visible, (void)logging, (void)inside;
    if (strcmp(token, "{linchpin}") || resources[0] != '/' || events || early) {
        log(environment, ERROR, "error", "wrong token");
        return NULL;
    }
    struct instance *own = calloc(1, sizeof *own);
    own->environment = environment;
    own->logger = (void *)log;
    take_defaults(own);
#ifdef UPDATES
    if (n) own->update = (void *)update;
#else
    (void)n, (void)update;
#endif
    return own;
}

int fmi3EnterInitializationMode(struct instance *own, bool has_tolerance, double tolerance, double t, bool ends, double end) {
    (void)has_tolerance, (void)tolerance, (void)ends, (void)end;
    start(own, t);
    return own->now.p[0] > 0 ? OK : ERROR;
}
int fmi3ExitInitializationMode(struct instance *own) { (void)own; return OK; }
int fmi3Terminate(struct instance *own) { (void)own; return OK; }
void fmi3FreeInstance(struct instance *own) { free(own); }

int fmi3GetFloat64(struct instance *own, const unsigned *vr, size_t n, double *v, size_t m) {
    (void)m;
    return get(own, vr, n, v);
}
int fmi3SetFloat64(struct instance *own, const unsigned *vr, size_t n, const double *v, size_t m) {
    (void)m;
    return set(own, vr, n, v);
}
int fmi3SetInt32(struct instance *own, const unsigned *vr, size_t n, const int32_t *v, size_t m) {
    (void)vr, (void)m;
    if (n) own->now.fault = v[0];
    return OK;
}
int fmi3SetBoolean(struct instance *own, const unsigned *vr, size_t n, const bool *v, size_t m) {
    (void)vr, (void)m;
    if (n) own->now.is_held = v[0];
    return OK;
}
int fmi3SetString(struct instance *own, const unsigned *vr, size_t n, const char *const *v, size_t m) {
    (void)vr, (void)m;
    if (n) strncpy(own->label, v[0], sizeof own->label - 1);
    return OK;
}

int fmi3DoStep(struct instance *own, double t, double h, bool never_back, bool *event, bool *ends, bool *early, double *reached) {
    (void)never_back;
    int status = step(own, t, h);
    *event = *ends = *early = false;
    *reached = own->now.t;
    if (status != OK)
        ((logger)own->logger)(own->environment, status, "error", own->label[0] ? own->label : "the spring is broken");
    return status;
}

#ifdef STATES
int fmi3GetFMUState(struct instance *own, void **state) {
    if (!*state) *state = malloc(sizeof own->now);
    memcpy(*state, &own->now, sizeof own->now);
    return OK;
}
int fmi3SetFMUState(struct instance *own, void *state) { memcpy(&own->now, state, sizeof own->now); return OK; }
int fmi3FreeFMUState(struct instance *own, void **state) { (void)own; free(*state); *state = NULL; return OK; }
int fmi3SerializedFMUStateSize(struct instance *own, void *state, size_t *n) { (void)state; *n = sizeof own->now; return OK; }
int fmi3SerializeFMUState(struct instance *own, void *state, uint8_t *to, size_t n) { (void)own; memcpy(to, state, n); return OK; }
int fmi3DeserializeFMUState(struct instance *own, const uint8_t *from, size_t n, void **state) {
    if (n != sizeof own->now) return ERROR;
    *state = malloc(n);
    memcpy(*state, from, n);
    return OK;
}
#endif
