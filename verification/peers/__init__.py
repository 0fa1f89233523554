"""Other people's solvers and our models on the same problems, live, in one run on one machine.

`rods`         rods in equilibrium, P1 to P4, P6 and P6n; `rodothers` and `rodours` who takes part on which meshes,
               `onestep` how much load each takes at once, `alone` one of our solves in a process of its own
`swing`        the swinging rod, P5, and `reference` its solution by none of those who take part (swing.json);
               `others` and `ours` who takes part, how each steps
`environment`  their interpreter in `.venv-peers`, made by `./run peers` from requirements.txt
`conversation` a question to it, answers or refusals back
`talk`         the other end of the line, with its own clock; it and the adapters load in that interpreter only:
               `exudyn` and `exudynrods`, `opensees`, `xara`, `elastica` and `elasticarods` (PyElastica), `mujoco` and
               `mujocorods`, with `rodshape` where nodes lie
`contest`      errors and seconds of each, and the quickest that is exact enough; `standing` who is ahead, and what
               ours should reach; `clock` how ours are timed
`race`         all of it as units of work

Nothing is imported here: the adapters' interpreter has neither our models nor what they need.
"""

__all__: list[str] = []
