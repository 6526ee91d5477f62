/* What an equation of motion has to define: sizes, rates of the states, outputs.
 *
 * Value references: parameters from 0, states from 20, inputs from 40, outputs from 60; 90 to 94 are faults. */
#define PARAMETERS 16
#define MOST_STATES 13
#define MOST_INPUTS 6
#define MOST_OUTPUTS 19

enum { PARAMETER = 0, STATE = 20, INPUT = 40, OUTPUT = 60, FAULT = 90, FAULT_AT, HELD, LABEL, FAULT_FROM };

struct equation {
    int states, inputs, outputs;
    double parameters_at_start[PARAMETERS], states_at_start[MOST_STATES];
    void (*rates)(const double *p, const double *s, const double *u, double *r);
    void (*outputs_of)(const double *p, const double *s, const double *u, double *y);
};
