module small
import "../../../etc/passwd"
