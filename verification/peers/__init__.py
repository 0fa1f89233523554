"""Other people's solvers and our models on the same problem, live, in one run on one machine.

`swing`        the problem, and `reference` its solution by none of those who take part (swing.json)
`others`       who takes part: how each is driven, what it assumes, a small sweep of meshes and steps
`ours`         both our models in the same sweep
`environment`  their interpreter in `.venv-peers`, made by `./run peers` from requirements.txt
`conversation` a question to it, an answer or a refusal back
`talk`         the other end of the line, with its own clock; it and the adapters load in that interpreter only:
`exudyn`, `opensees`, `elastica` (PyElastica) and `mujoco`
`contest`      errors and seconds of each, and the quickest that is exact enough

Nothing is imported here: the adapters' interpreter has neither our models nor what they need.
"""

__all__: list[str] = []
