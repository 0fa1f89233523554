"""What the two models are worth: errors against independent references, errors against time, each against the other.

    dolfinrod verify [CASE ...] [--quick] [--out DIR]          the same: python -m verification

`case`          a problem, what is read off, and its reference with provenance
`cases`         one file a family
`statement`     a case in words
`references`    the numbers and where they come from; closed forms
`models`        adapters that solve a scene with either model
`workprecision` the only clock
`order`         observed orders
`reach`         seconds to a given error
`crosscheck`    both models against each other, no reference involved
`laws`          what holds whatever the numbers are: `violations` of it, on `lawscenes`
`onestep`       whole loads in one step: Newton iterations against limits
`speed`         milliseconds against limits and against other people's solvers
`peers`         other people's solvers and our models on one problem, live; `./run peers` installs them
`eigencase`     a critical load or a frequency as a case; `eigencases`, a file a family; `eigenmodels`, who is asked
`stability`     critical loads and frequencies against references, verdicts below and above
`hardcase`      what solvers stumble over, with a check; `hardcases`, such scenes; `hard`, how they end
`meetings`      rods on rods with known answers, taken as contact cases are
`rigid`         rigid tops through each rotation integrator; `rigidbodies`, both of them; `toptrials`, as units
`bundles`       what more and more fibres cost, each bundle by `bundlerun`; `bundletrials`, as units
`limit`         where the time of an iteration goes, by `limitrun`; `growth` on finer meshes; `cold` processes;
                `growthtrials`, as units
`robustness`    largest load in one step; fewest steps of `benchmarks`
`checks`        errors, orders and digits that must hold
`shape`         what is drawn
`plan`          all that is to be done, as units; `trials`, those of stability, hard cases and robustness
`ledger`        finished units on disk; `interrupt` and `progress` of a run
`suite`         all of it, as one record
`report`        the record as a page and as JSON

Nothing is imported here: the thread count is settled (`__main__`) before NumPy loads.
"""

__all__: list[str] = []
