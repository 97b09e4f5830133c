"""The structure that the schemas of JUnit XML have in common, checked by hand.

They are JUnit.xsd for the reports of Apache Ant (github.com/windyroad/JUnit-Schema) and
junit-10.xsd of Jenkins' xUnit plugin (github.com/jenkinsci/xunit-plugin).
"""

import re
from xml.etree import ElementTree

WHOLE = re.compile(r"\d+")
SECONDS = re.compile(r"\d+(\.\d+)?")
SOME = re.compile(r".+", re.DOTALL)
#: Of each element, the attributes that it has in both, and of what form.
ATTRIBUTES = {
    "testsuites": {},
    "testsuite": {
        **{"name": SOME, "package": SOME, "hostname": SOME, "id": WHOLE, "tests": WHOLE},
        **{"failures": WHOLE, "errors": WHOLE, "time": SECONDS},
        "timestamp": re.compile(r"\d{4}-\d\d-\d\dT\d\d:\d\d:\d\d"),
    },
    "properties": {},
    "testcase": {"name": SOME, "classname": SOME, "time": SECONDS},
    "failure": {"type": SOME, "message": SOME},
    "error": {"type": SOME, "message": SOME},
    "system-out": {},
    "system-err": {},
}
#: And the elements in it, in their order.
CHILDREN = {
    "testsuites": r"(testsuite )*",
    "testsuite": r"properties (testcase )*system-out system-err ",
    "testcase": r"((failure|error) )?",
}


def read_junit(raw: bytes) -> ElementTree.Element:
    """The only test suite of a JUnit XML file, which is as the schemas say."""
    root = ElementTree.fromstring(raw)
    assert root.tag == "testsuites" and len(root) == 1
    for element in root.iter():
        forms = ATTRIBUTES[element.tag]
        assert element.attrib.keys() == forms.keys(), element.tag
        for name, form in forms.items():
            assert form.fullmatch(element.attrib[name]), (element.tag, name)
        children = "".join(f"{child.tag} " for child in element)
        assert re.fullmatch(CHILDREN.get(element.tag, ""), children), element.tag
    (suite,) = root
    cases = suite.findall("testcase")
    assert int(suite.attrib["tests"]) == len(cases)
    for kind in ("failure", "error"):
        assert int(suite.attrib[f"{kind}s"]) == len(suite.findall(f"testcase/{kind}"))
    return suite
