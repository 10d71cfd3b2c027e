/* HSL_MA97's C interface as a shared library: every call goes to what was registered.
 *
 * Ipopt from 3.14 on opens the library named by its option hsllib and looks these names up. The
 * program that carries the library registers its own functions first. Structs are passed on by
 * address and are not looked into. */

struct routines {
    void (*default_control)(void *control);
    void (*analyse)(int check, int n, const int *ptr, const int *row, double *val, void **akeep,
                    const void *control, void *info, int *order);
    void (*factor)(int type, const int *ptr, const int *row, const double *val, void **akeep,
                   void **fkeep, const void *control, void *info, const double *scale);
    void (*factor_solve)(int type, const int *ptr, const int *row, const double *val, int nrhs,
                         double *x, int ldx, void **akeep, void **fkeep, const void *control,
                         void *info, const double *scale);
    void (*solve)(int job, int nrhs, double *x, int ldx, void **akeep, void **fkeep,
                  const void *control, void *info);
    void (*finalise)(void **akeep, void **fkeep);
    void (*free_akeep)(void **akeep);
};

static struct routines registered;

void ipopt_sys_register_ma97(const struct routines *routines) { registered = *routines; }

void ma97_default_control_d(void *control) { registered.default_control(control); }

void ma97_analyse_d(int check, int n, const int *ptr, const int *row, double *val, void **akeep,
                    const void *control, void *info, int *order)
{
    registered.analyse(check, n, ptr, row, val, akeep, control, info, order);
}

void ma97_factor_d(int type, const int *ptr, const int *row, const double *val, void **akeep,
                   void **fkeep, const void *control, void *info, const double *scale)
{
    registered.factor(type, ptr, row, val, akeep, fkeep, control, info, scale);
}

void ma97_factor_solve_d(int type, const int *ptr, const int *row, const double *val, int nrhs,
                         double *x, int ldx, void **akeep, void **fkeep, const void *control,
                         void *info, const double *scale)
{
    registered.factor_solve(type, ptr, row, val, nrhs, x, ldx, akeep, fkeep, control, info, scale);
}

void ma97_solve_d(int job, int nrhs, double *x, int ldx, void **akeep, void **fkeep,
                  const void *control, void *info)
{
    registered.solve(job, nrhs, x, ldx, akeep, fkeep, control, info);
}

void ma97_finalise_d(void **akeep, void **fkeep) { registered.finalise(akeep, fkeep); }

void ma97_free_akeep_d(void **akeep) { registered.free_akeep(akeep); }
