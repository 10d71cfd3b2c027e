"""Eight goals of one arm, planned side by side."""

import ffsm_ipopt as ffsm

problem = ffsm.Problem.from_toml("config/table1-smooth.toml")
goals = [0.9 + 0.05 * k for k in range(8)]
problems = [problem.with_values({"task.final.joints[1]": goal}) for goal in goals]
records = ffsm.plan_many(problems)
for goal, record in zip(goals, records):
    assert record.status == "solved", record.reason
    print(f"{goal:.2f} rad: J = {record.figures.objective:.6f}, {record.seconds:.3f} s")
