"""libcosim (C++, by way of libcosimpy) runs an FMU: prints the outputs, as exact numbers, of each point asked for."""

import sys
import zipfile
from xml.etree import ElementTree

from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimObserver import CosimObserver
from libcosimpy.CosimSlave import CosimLocalSlave

fmu, step, count, every, *names = sys.argv[1:]
description = ElementTree.fromstring(zipfile.ZipFile(fmu).read("modelDescription.xml"))
reference = {v.get("name"): int(v.get("valueReference")) for v in description.iter("ScalarVariable")}
execution = CosimExecution.from_step_size(step_size=round(float(step) * 1e9))
slave = execution.add_local_slave(CosimLocalSlave(fmu_path=fmu, instance_name="model"))
observer = CosimObserver.create_last_value()
execution.add_observer(observer)
for k in range(1, int(count) + 1):
    assert execution.step()
    if k % int(every) == 0:
        values = observer.last_real_values(slave, [reference[name] for name in names])
        print("values", *(value.hex() for value in values))
